// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/resample.hpp"

namespace tricue::bindings {

void define_fuse(py::module_& m) {
    m.def(
        "resample",
        [](const py::object& weights, double offset) {
            const auto view = vector(weights, "weights");
            Indices chosen;
            {
                py::gil_scoped_release unlocked;
                chosen = resample(view, offset);
            }
            return give(std::move(chosen));
        },
        py::arg("weights"), py::arg("offset"),
        "Systematic resampling: N indices, ascending, drawn by one comb shifted by offset in [0, 1).");
}

}  // namespace tricue::bindings

// SPDX-License-Identifier: MIT
#include <pybind11/pybind11.h>

namespace tricue::bindings {
void define_bayes(pybind11::module_& m);
void define_build_info(pybind11::module_& m);
void define_color(pybind11::module_& m);
void define_color_search(pybind11::module_& m);
void define_correlation(pybind11::module_& m);
void define_depth(pybind11::module_& m);
void define_depth_filter(pybind11::module_& m);
void define_depth_objects(pybind11::module_& m);
void define_fuse(pybind11::module_& m);
void define_imgproc(pybind11::module_& m);
void define_kalman(pybind11::module_& m);
void define_motion(pybind11::module_& m);
void define_patch(pybind11::module_& m);
void define_skin(pybind11::module_& m);
void define_stereo(pybind11::module_& m);
void define_target(pybind11::module_& m);
}  // namespace tricue::bindings

PYBIND11_MODULE(_core, m) {
    m.doc() =
        "tricue's native kernels: arrays in, arrays out, no state. Their NumPy twins are in "
        "tricue.reference.";
    tricue::bindings::define_color(m);
    tricue::bindings::define_color_search(m);
    tricue::bindings::define_patch(m);
    tricue::bindings::define_skin(m);
    tricue::bindings::define_depth(m);
    tricue::bindings::define_depth_objects(m);
    tricue::bindings::define_stereo(m);
    tricue::bindings::define_motion(m);
    tricue::bindings::define_depth_filter(m);
    tricue::bindings::define_fuse(m);
    tricue::bindings::define_correlation(m);
    tricue::bindings::define_target(m);
    tricue::bindings::define_kalman(m);
    tricue::bindings::define_bayes(m);
    tricue::bindings::define_imgproc(m);
    tricue::bindings::define_build_info(m);
}

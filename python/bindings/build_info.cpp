// SPDX-License-Identifier: MIT
// What the extension was built with, which tricue doctor tells.
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <opencv2/core/version.hpp>
#include <string>

#include "base/simd.hpp"

namespace tricue::bindings {
namespace {

std::string compiler() {
#if defined(__clang__)
    return __VERSION__;  // which says Clang
#elif defined(__GNUC__)
    return std::string("GCC ") + __VERSION__;
#elif defined(_MSC_VER)
    return "MSVC " + std::to_string(_MSC_VER);
#else
    return "unknown";
#endif
}

std::string eigen() {
    return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
           std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

void define_build_info(pybind11::module_& core) {
    pybind11::dict info;
    info["compiler"] = compiler();
    info["opencv"] = CV_VERSION;
    info["eigen"] = eigen();
    info["instructions"] = instructions_in_use();
    core.attr("_build_info") = info;
}

}  // namespace tricue::bindings

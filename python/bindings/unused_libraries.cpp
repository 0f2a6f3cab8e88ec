// SPDX-License-Identifier: MIT
// Stands for the libraries that Debian's static OpenCV core names and that nobody here calls, so that a wheel brings neither LAPACK
// and a Fortran runtime (9 MB) nor X11: LAPACK and BLAS work for cv::solve, cv::invert, cv::SVD, cv::eigen and cv::gemm on matrices
// of a hundred rows or more, GLX for OpenCL beside OpenGL, zlib for compressed cv::FileStorage. We call cv::dft and the filters of
// imgproc, whose largest matrix, a homography to be inverted, is 3x3 and solved in closed form.
//
// Only the linker sees these; a call, which would be a mistake of ours, ends the process and says so.
#include <cstdio>
#include <cstdlib>

#define TRICUE_UNUSED(name)                                                                          \
    [[noreturn]] void name() {                                                                       \
        std::fputs("tricue: OpenCV calls " #name ", which a wheel doesn't have: please report it\n", \
                   stderr);                                                                          \
        std::abort();                                                                                \
    }
#define TRICUE_UNUSED_LAPACK(routine) TRICUE_UNUSED(s##routine##_) TRICUE_UNUSED(d##routine##_)

extern "C" {
TRICUE_UNUSED_LAPACK(gels)
TRICUE_UNUSED_LAPACK(geqrf)
TRICUE_UNUSED_LAPACK(gesdd)
TRICUE_UNUSED_LAPACK(gesv)
TRICUE_UNUSED_LAPACK(getrf)
TRICUE_UNUSED_LAPACK(posv)
TRICUE_UNUSED_LAPACK(potrf)
TRICUE_UNUSED(cblas_sgemm)
TRICUE_UNUSED(cblas_dgemm)
TRICUE_UNUSED(cblas_cgemm)
TRICUE_UNUSED(cblas_zgemm)
TRICUE_UNUSED(glXGetCurrentContext)
TRICUE_UNUSED(glXGetCurrentDisplay)
TRICUE_UNUSED(glXGetProcAddressARB)
TRICUE_UNUSED(gzclose)
TRICUE_UNUSED(gzeof)
TRICUE_UNUSED(gzgets)
TRICUE_UNUSED(gzopen)
TRICUE_UNUSED(gzputs)
TRICUE_UNUSED(gzrewind)
}

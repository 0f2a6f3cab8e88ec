// SPDX-License-Identifier: MIT
#include "camera/reduce_gray.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/check.hpp"

namespace tricue {

GrayImage reduce_gray(const ImageView& image, int step) {
    const int most = std::min(image.rows, image.cols);
    if (step < 1 || step > most) refuse("step", "1 to the image's smaller side", step);
    GrayImage cells(image.rows / step, image.cols / step);
    cv::Mat result(static_cast<int>(cells.rows()), static_cast<int>(cells.cols()), CV_8U, cells.data());
    const int rows = result.rows * step, cols = result.cols * step;
    const cv::Mat pixels(
        rows, cols, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.data),
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(image.stride, cols * image.channels)));
    if (step == 1) {
        image.channels == 1 ? pixels.copyTo(result) : cv::cvtColor(pixels, result, cv::COLOR_BGR2GRAY);
        return cells;
    }
    cv::Mat gray = pixels;
    if (image.channels == 3) cv::cvtColor(pixels, gray = cv::Mat(), cv::COLOR_BGR2GRAY);
    cv::resize(gray, result, result.size(), 0, 0, cv::INTER_AREA);
    return cells;
}

}  // namespace tricue

// Separable convolution of one plane of doubles; beyond the border the nearest pixel is repeated.
#pragma once

#include <span>
#include <vector>

namespace volumark {

using Plane = std::vector<double>;  // width * height, tight rows

// Correlates rows with `horizontal` and columns with `vertical`; both have odd length, centre in the middle.
Plane convolve(const Plane& source, int width, int height, std::span<const double> horizontal,
               std::span<const double> vertical);
Plane convolve_rows(const Plane& source, int width, int height, std::span<const double> kernel);
Plane convolve_columns(const Plane& source, int width, int height, std::span<const double> kernel);

// exp(-x^2 / (2 sigma^2)) at x = -radius .. radius, sum 1.
std::vector<double> gaussian_kernel(double sigma, int radius);

}  // namespace volumark

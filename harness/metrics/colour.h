// Colour spaces that the metrics need, D65. `xyz` is relative to the white of linear sRGB (1, 1, 1), so white is
// (1, 1, 1) there too.
#pragma once

#include <glm/vec3.hpp>

namespace volumark {

double srgb_encode(double linear);   // clamps to [0, 1]
double srgb_decode(double encoded);  // clamps to [0, 1]

glm::dvec3 xyz_of(const glm::dvec3& linear_rgb);
glm::dvec3 linear_rgb_of(const glm::dvec3& xyz);
glm::dvec3 lab_of(const glm::dvec3& xyz);  // CIE L*a*b*

// Sharma, Wu and Dalal 2005; kL = kC = kH = 1.
double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2);

}  // namespace volumark

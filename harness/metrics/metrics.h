// How wrong an image is. Inputs are premultiplied linear RGBA of equal size; RGB is compared over the scene's
// background, alpha apart. No figure alone decides: see docs of each. Pixels that are not finite are counted first,
// kept out of every other figure, and fail on their own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/image.h"

namespace volumark {

// Images or masks that do not fit together, or hold no pixel.
class MetricError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CompareOptions {
  glm::dvec3 background{0};       // linear RGB
  std::span<const uint8_t> mask;  // width * height, row 0 on top: only pixels != 0 count; empty: all of them
  bool perceptual = true;         // SSIM, FLIP and CIEDE2000 too (the slow ones)
};

// Per-pixel figures run over the finite pixels of the mask. A percentile p is the smallest value with at least the
// share p of the pixels at or below it.
struct Errors {
  int64_t pixels = 0;                 // that were compared
  int64_t non_finite = 0;             // pixels of the mask with a NaN or an infinity in either image
  double mae = 0, rmse = 0, max = 0;  // over the RGB channels
  int max_x = -1, max_y = -1;         // where `max` is; -1 where no pixel was compared
  std::optional<double> psnr;         // -20 log10(rmse), peak 1; none when equal
  std::array<double, 3> bias{};       // mean(test - reference) per channel
  double p50 = 0, p95 = 0, p99 = 0;   // of each pixel's largest channel error
  double over_1_255 = 0;              // fraction of pixels whose largest channel error exceeds 1/255
  double alpha_mae = 0, alpha_rmse = 0, alpha_max = 0;
  // Only with `perceptual`. RGB is clamped to [0, 1]; a non-finite pixel takes the reference's value there.
  std::optional<double> ssim;  // sRGB luma, mean over the window centres in the mask; none below 11 x 11
  std::optional<double> flip_mean, flip_p99;
  std::optional<double> ciede2000_mean, ciede2000_p99;
};

// Throws MetricError for unequal or empty sizes and for a mask of another size.
Errors compare_images(const Image& test, const Image& reference, const CompareOptions& options = {});

// `image` over an opaque background; alpha becomes 1.
Image composite(const Image& image, const glm::dvec3& background);

// FLIP of each pixel (LDR-FLIP, 67.0206 pixels per degree), width * height values in [0, 1].
std::vector<float> flip_map(const Image& test, const Image& reference, const glm::dvec3& background = glm::dvec3(0));

// For the report: opaque linear RGB. Signed difference: 50 % sRGB grey is equal, each channel lighter where the test is
// higher; it saturates at a difference of `full_scale`. Heat map: magma, black at 0. Non-finite pixels are pure
// magenta.
Image signed_difference_picture(const Image& test, const Image& reference, double full_scale = 0.05,
                                const glm::dvec3& background = glm::dvec3(0));
Image flip_picture(std::span<const float> map, int width, int height);

// Do two backends agree? A pixel is at a silhouette where the 3 x 3 neighbourhood's alpha, in either image, spans more
// than `silhouette_span`; all others are interior. Differences are the largest over the four premultiplied channels; a
// pixel that is not finite in either image differs by infinity.
struct ParityLimits {
  double silhouette_span = 0.1;
  double difference = 2e-3;           // allowed in any interior pixel
  double silhouette_fraction = 1e-3;  // share of the silhouette's pixels that may exceed `difference`
  // Pictures of isosurfaces have edges that alpha does not show, one part before another: all pixels count as at a
  // silhouette.
  bool hidden_edges = false;
};
struct Parity {
  int64_t interior_pixels = 0, interior_over = 0;
  double interior_max = 0;
  int interior_x = -1, interior_y = -1;  // where interior_max is
  int64_t silhouette_pixels = 0, silhouette_over = 0;
  double silhouette_max = 0;
  double silhouette_fraction = 0;  // silhouette_over / silhouette_pixels; 0 where there is no silhouette
  bool agree = false;              // within the limits
};
Parity parity(const Image& a, const Image& b, const ParityLimits& limits = {});

// The metrics measured on inputs with known answers: every report carries these rows, the tests check them.
struct SelfTest {
  std::string name;
  double expected = 0, measured = 0, tolerance = 0;
  bool pass() const { return measured >= expected - tolerance && measured <= expected + tolerance; }
};
std::vector<SelfTest> metric_self_test();

}  // namespace volumark

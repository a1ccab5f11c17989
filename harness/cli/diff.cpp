// volumark diff: how two images differ.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "harness/cli/commands.h"
#include "harness/gates.h"
#include "harness/image_io.h"

namespace volumark::cli {
namespace {

struct DiffOptions {
  std::string a, b, out, flip;
  std::map<std::string, double> limits;
  std::optional<double> rmse, max, bias, flip_p99;
  bool json = false;
};

std::vector<std::pair<std::string, double>> rows_of(const ErrorMetrics& e) {
  return {{"pixels", static_cast<double>(e.pixels)},
          {"non_finite", static_cast<double>(e.non_finite)},
          {"mae", e.mae},
          {"rmse", e.rmse},
          {"max", e.max},
          {"max_x", static_cast<double>(e.max_x)},
          {"max_y", static_cast<double>(e.max_y)},
          {"psnr", e.psnr},
          {"bias_r", e.bias[0]},
          {"bias_g", e.bias[1]},
          {"bias_b", e.bias[2]},
          {"p50", e.p50},
          {"p95", e.p95},
          {"p99", e.p99},
          {"over_1_255", e.over_1_255},
          {"ssim", e.ssim},
          {"flip_mean", e.flip_mean},
          {"flip_p99", e.flip_p99},
          {"ciede2000_mean", e.ciede2000_mean},
          {"ciede2000_p99", e.ciede2000_p99},
          {"alpha_mae", e.alpha_mae},
          {"alpha_rmse", e.alpha_rmse},
          {"alpha_max", e.alpha_max}};
}

void print_errors(const ErrorMetrics& errors, bool as_json) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, value] : rows_of(errors)) {
    json[name] = value;  // what is not finite prints as null
    if (!as_json) fmt::print("{:<16} {:.8g}\n", name, value);
  }
  if (as_json) fmt::print("{}\n", json.dump(2));
}

int diff(const DiffOptions& options) {
  const Image a = read_image(options.a), b = read_image(options.b);
  const ErrorMetrics errors = error_metrics(compare_images(a, b));
  print_errors(errors, options.json);
  if (!options.out.empty()) write_image(options.out, signed_difference_picture(a, b), glm::dvec3(0));
  if (!options.flip.empty()) write_image(options.flip, flip_picture(flip_map(a, b), a.width, a.height), glm::dvec3(0));
  std::map<std::string, double> limits;
  if (options.rmse) limits["rmse"] = *options.rmse;
  if (options.max) limits["max"] = *options.max;
  if (options.bias) limits["bias"] = *options.bias;
  if (options.flip_p99) limits["flip_p99"] = *options.flip_p99;
  const auto reason = wrong_image_reason(errors, limits);
  if (!reason) return kOk;
  fmt::print(stderr, "volumark: {} differs from {}: {}\n", options.a, options.b, *reason);
  return kBadNews;
}

}  // namespace

void add_diff(CLI::App& app, const Globals&, Action& action) {
  auto options = std::make_shared<DiffOptions>();
  CLI::App* command = app.add_subcommand("diff", "Compare two images by every metric");
  command->add_option("a", options->a, "the image to test (.exr, .png, .pfm)")->required();
  command->add_option("b", options->b, "the image to compare with")->required();
  command->add_option("--out,-o", options->out, "picture of the signed difference");
  command->add_option("--flip", options->flip, "picture of the FLIP map");
  command->add_option("--max-rmse", options->rmse, "exit 1 above this RMSE");
  command->add_option("--max-error", options->max, "exit 1 above this largest difference");
  command->add_option("--max-bias", options->bias, "exit 1 above this signed mean difference, in any channel");
  command->add_option("--max-flip-p99", options->flip_p99, "exit 1 above this 99th percentile of FLIP");
  command->add_flag("--json", options->json, "as JSON");
  command->footer(
      "Images with NaN or infinity always exit 1.\nExample: volumark diff a.exr b.exr --out diff.png "
      "--max-rmse 0.001");
  command->callback([&action, options] { action = [options] { return diff(*options); }; });
}

}  // namespace volumark::cli

#include "harness/cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "harness/environment.h"
#include "harness/frame.h"
#include "harness/gates.h"
#include "harness/run_folder.h"
#include "harness/sampler.h"
#include "reports/analysis.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

// An outcome that ends a cell early.
struct Ended {
  Outcome outcome;
  std::string reason;
};

Device open_device(const std::string& backend, const CellOptions& options) {
  try {
    return make_device(backend, options.device);
  } catch (const DeviceError& error) {
    throw Ended{options.require_backends ? Outcome::Failed : Outcome::Unsupported,
                fmt::format("backend {} cannot be opened: {}", backend, error.what())};
  }
}

void check_context(const SceneContext& context) {
  if (context.missing) throw Ended{Outcome::Unsupported, *context.missing};
  if (context.broken) throw Ended{Outcome::Failed, *context.broken};
}

bool keeps(const Experiment& experiment, const SceneContext& context, int view) {
  return experiment.images == Experiment::Images::All ||
         (experiment.images == Experiment::Images::First && view == context.views.front());
}

std::string picture_stem(const Cell& cell, int view) {
  return fmt::format("{}/{}-{}-{}-v{}", cell.key.scene, cell.key.method, cell.backend,
                     sha256_hex(std::string_view(key_text(cell.key))).substr(0, 10), view);
}

void store_pictures(const PictureStore& store, const Cell& cell, const SceneContext& context, const Image& image,
                    ViewResult& view) {
  const auto index = static_cast<int>(view.index);
  const std::string stem = picture_stem(cell, index);
  const glm::dvec3& background = context.scene.background;
  view.rendered = store.linear(stem, image, background);
  const auto reference = context.references.find(index);
  if (reference == context.references.end()) return;
  view.reference_image = context.reference_files.at(index);
  view.difference =
      store.shown(stem + "-difference", signed_difference_picture(image, reference->second.image, 0.05, background));
  view.flip = store.shown(
      stem + "-flip", flip_picture(flip_map(image, reference->second.image, background), image.width, image.height));
}

void measure_errors(const SceneContext& context, const Image& image, ViewResult& view) {
  const auto reference = context.references.find(static_cast<int>(view.index));
  if (reference == context.references.end()) return;
  CompareOptions options;
  options.background = context.scene.background;
  view.error = error_metrics(compare_images(image, reference->second.image, options));
  view.reference = context.reference_infos.at(static_cast<int>(view.index));
  view.at_bound = view.error->max <= view.reference->bound;
}

void fill_errors(const Group& group, const SceneContext& context, const std::map<int, Image>& images, Result& result) {
  std::vector<ErrorMetrics> errors;
  for (ViewResult& view : result.views) {
    const auto image = images.find(static_cast<int>(view.index));
    if (image == images.end()) continue;
    measure_errors(context, image->second, view);
    if (view.error) errors.push_back(*view.error);
  }
  if (errors.empty()) return;
  result.error = over_views(errors);
  std::map<std::string, double> limits = group.experiment->limits;
  if (group.finest)
    for (const auto& [metric, limit] : group.experiment->finest_limits) limits[metric] = limit;
  if (const auto reason = wrong_image_reason(result.error->worst, limits)) throw Ended{Outcome::WrongImage, *reason};
}

void draw_and_measure(const Group& group, const Cell& cell, const SceneContext& context, const CellOptions& options,
                      std::optional<BackendInfo>& backend, std::map<int, Image>& images, Result& result) {
  check_context(context);
  Device device = open_device(cell.backend, options);
  backend = device.info();
  if (const auto reason = unsupported_reason(*group.method, context.scene, group.values, device.info()))
    throw Ended{Outcome::Unsupported, *reason};
  FrameSampler sampler(*group.experiment, context, options.stop);
  try {
    sampler.run(*group.method, group.values, device, result, images);
  } catch (const TimedOut& timeout) {
    sampler.finish(result);
    throw Ended{Outcome::Timeout, timeout.reason};
  }
}

}  // namespace

std::string case_version(const Group& group, const SceneContext& context) {
  std::string text =
      fmt::format("{} {}x{} reference {} tolerance {:a} method {}", context.scene.hash, context.width, context.height,
                  kReferenceVersion, group.experiment->reference_tolerance, group.method->info().name);
  for (const auto& [name, value] : group.values) text += fmt::format(" {}={}", name, to_string(value));
  for (const int view : context.views) text += fmt::format(" view {}", view);
  return sha256_hex(std::string_view(text)).substr(0, 16);
}

Result run_cell(const Group& group, const Cell& cell, const SceneContext& context, const CellOptions& options,
                const PictureStore& store, std::optional<BackendInfo>& backend, std::map<int, Image>& images) {
  Result result;
  result.key = cell.key;
  result.case_version = case_version(group, context);
  result.effects = effect_names(context.scene.effects);
  result.width = context.width;
  result.height = context.height;
  result.quality = group.quality;
  result.command = cell.command;
  if (group.method->info().expected_order != nullptr)
    result.order.expected = group.method->info().expected_order(group.values);
  try {
    draw_and_measure(group, cell, context, options, backend, images, result);
    result.outcome = Outcome::Ok;
    fill_errors(group, context, images, result);
  } catch (const Ended& ended) {
    result.outcome = ended.outcome;
    result.reason = ended.reason;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    result.outcome = Outcome::Failed;
    result.reason = "out of memory";
  } catch (const std::exception& error) {
    result.outcome = Outcome::Failed;
    result.reason = error.what();
  }
  for (ViewResult& view : result.views) {
    const auto index = static_cast<int>(view.index);
    const auto image = images.find(index);
    if (image != images.end() && keeps(*group.experiment, context, index))
      store_pictures(store, cell, context, image->second, view);
  }
  result.finished_at = utc_now();
  return result;
}

std::map<int, Image> draw_cell(const Group& group, const Cell& cell, const SceneContext& context,
                               const CellOptions& options) {
  std::map<int, Image> images;
  try {
    Device device = make_device(cell.backend, options.device);
    FrameSource source(context.scene, *group.method, group.values, device, context.width, context.height);
    for (const int view : context.views) {
      source.frame(context.scene.views[static_cast<size_t>(view)]);
      images[view] = source.read_back();
    }
  } catch (const std::exception&) {  // it was drawn before; without its pictures it is not compared again
    images.clear();
  }
  return images;
}

}  // namespace volumark

#include "harness/cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "harness/effect_variants.h"
#include "harness/environment.h"
#include "harness/frame.h"
#include "harness/gates.h"
#include "harness/jump.h"
#include "harness/program_cost.h"
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

std::string picture_stem(const Cell& cell, int view, const std::vector<std::string>& ignored) {
  std::string stem = fmt::format("{}/{}-{}-{}-v{}", cell.key.scene, cell.key.method, cell.backend,
                                 sha256_hex(std::string_view(key_text(cell.key))).substr(0, 10), view);
  for (const std::string& effect : ignored) stem += "-ignored-" + effect;
  return stem;
}

void store_pictures(const PictureStore& store, const Cell& cell, const SceneContext& context, const Image& image,
                    const std::vector<std::string>& ignored, ViewResult& view) {
  const auto index = static_cast<int>(view.index);
  const std::string stem = picture_stem(cell, index, ignored);
  const glm::dvec3& background = context.scene.background;
  view.rendered = store.linear(stem, image, background, ignored_note(ignored));
  const auto reference = context.references.find(index);
  if (reference == context.references.end() || !view.error) return;
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
  const RegionMap& regions = context.regions.at(static_cast<int>(view.index));
  view.error->regions = region_errors(image, reference->second.image, regions, options.background);
  view.shows_nothing = regions.shows_nothing;
  view.reference = context.reference_infos.at(static_cast<int>(view.index));
  view.at_bound = view.error->max <= view.reference->bound;
}

// A reference without an effect is not the truth of a picture that has it.
bool comparable(const SceneContext& context, const Result& result) {
  return std::none_of(context.unreferenced.begin(), context.unreferenced.end(), [&](const std::string& effect) {
    return std::find(result.effects.begin(), result.effects.end(), effect) != result.effects.end();
  });
}

void fill_errors(const Group& group, const SceneContext& context, const std::map<int, Image>& images, Result& result) {
  if (!comparable(context, result)) return;
  std::vector<ErrorMetrics> errors, telling;  // of all views; of those that show something
  for (ViewResult& view : result.views) {
    const auto image = images.find(static_cast<int>(view.index));
    if (image == images.end()) continue;
    measure_errors(context, image->second, view);
    if (!view.error) continue;
    errors.push_back(*view.error);
    if (!view.shows_nothing) telling.push_back(*view.error);
  }
  measure_jumps(context, images, result);
  if (errors.empty()) return;
  if (telling.empty())
    result.reason = "every view shows the background alone: equal pictures say nothing of the error";
  else
    result.error = over_views(telling);
  std::map<std::string, double> limits = group.experiment->limits;
  if (group.finest)
    for (const auto& [metric, limit] : group.experiment->finest_limits) limits[metric] = limit;
  if (const auto reason = wrong_image_reason(over_views(errors).worst, limits))
    throw Ended{Outcome::WrongImage, *reason};
}

}  // namespace

std::string case_version(const Group& group, const Cell& cell, const SceneContext& scene_context) {
  const SceneContext& context = scene_context.of(cell.key.variant);
  std::string text =
      fmt::format("{} {}x{} reference {} tolerance {:a} method {}", context.scene.hash, context.width, context.height,
                  kReferenceVersion, group.experiment->reference_tolerance, group.method->info().name);
  for (const auto& [name, value] : group.values) text += fmt::format(" {}={}", name, to_string(value));
  for (const int view : context.views) text += fmt::format(" view {}", view);
  if (group.ignore_effects && !effect_names(context.scene.effects).empty()) text += " ignoring effects";
  return sha256_hex(std::string_view(text)).substr(0, 16);
}

CellRun::CellRun(const Group& group, const Cell& cell, const SceneContext& context, const CellOptions& options)
    : group_(group), cell_(cell), context_(context.of(cell.key.variant)), options_(options), scene_(context_.scene) {
  result_.key = cell.key;
  result_.case_version = case_version(group, cell, context);
  result_.effects = effect_names(scene_.effects);
  result_.width = context.width;
  result_.height = context.height;
  result_.quality = group.quality;
  result_.command = cell.command;
  // In the arithmetic of fixed_point smaller steps mean more rounding, and no order of convergence holds.
  if (group.method->info().expected_order != nullptr && !scene_.effects.fixed_point)
    result_.order.expected = group.method->info().expected_order(group.values);
}

CellRun::~CellRun() = default;

void CellRun::end(Outcome outcome, const std::string& reason) {
  ended_ = true;
  result_.outcome = outcome;
  result_.reason = reason;
}

// Runs `work`; whatever goes wrong in it ends the cell. False: it has ended.
template <class Work>
bool CellRun::guarded(Work work) {
  if (ended_) return false;
  try {
    work();
  } catch (const Ended& ended) {
    end(ended.outcome, ended.reason);
  } catch (const TimedOut& timeout) {
    end(Outcome::Timeout, timeout.reason);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    end(Outcome::Failed, "out of memory");
  } catch (const std::exception& error) {
    end(Outcome::Failed, error.what());
  }
  return !ended_;
}

// Leaves out what the method cannot simulate; the result says so, and so does the command that draws it again.
void CellRun::ignore_effects() {
  result_.ignored_effects = effects_to_ignore(*group_.method, scene_, group_.values, device_->info());
  if (result_.ignored_effects.empty()) return;
  scene_ = without_effects(scene_, result_.ignored_effects);
  result_.effects = effect_names(scene_.effects);
}

void CellRun::open() {
  guarded([this] {
    if (const auto other = display_reason(*group_.method, scene_)) throw Ended{Outcome::Unsupported, *other};
    if (!group_.ignore_effects)  // before any work: data, Device, references
      if (const auto reason = missing_effect_reason(*group_.method, scene_.effects))
        throw Ended{Outcome::Unsupported, *reason};
    check_context(context_);
    device_ = std::make_unique<Device>(open_device(cell_.backend, options_));
    backend_ = device_->info();
    if (group_.ignore_effects) ignore_effects();
    if (const auto reason = unsupported_reason(*group_.method, scene_, group_.values, device_->info()))
      throw Ended{Outcome::Unsupported, *reason};
    if (context_.want_references) context_.want_references();
    check_context(context_);
    reset_peak_resident();
    sampler_ = std::make_unique<FrameSampler>(*group_.experiment, context_, options_.stop);
    sampler_->begin(scene_, *group_.method, group_.values, *device_, result_, images_);
    result_.programs = program_costs(device_->programs());
  });
}

bool CellRun::pass() {
  bool more = false;
  return guarded([this, &more] { more = sampler_->pass(); }) && more;
}

Result CellRun::finish(const PictureStore& store) {
  // A cell that failed half way has no figures; one that ran out of time keeps those that it has.
  const bool measured = !ended_ || result_.outcome == Outcome::Timeout;
  if (sampler_ && measured) sampler_->finish(result_);
  if (result_.metrics) {
    int64_t& peak = result_.metrics->peak_bytes.process;
    peak = std::max<int64_t>(0, peak - held_by_others_);
  }
  sampler_.reset();
  device_.reset();
  if (guarded([this] { fill_errors(group_, context_, images_, result_); })) result_.outcome = Outcome::Ok;
  for (ViewResult& view : result_.views) {
    const auto index = static_cast<int>(view.index);
    const auto image = images_.find(index);
    if (image != images_.end() && keeps(*group_.experiment, context_, index))
      store_pictures(store, cell_, context_, image->second, result_.ignored_effects, view);
  }
  result_.finished_at = utc_now();
  return std::move(result_);
}

std::map<int, Image> draw_cell(const Group& group, const Cell& cell, const SceneContext& scene_context,
                               const CellOptions& options) {
  const SceneContext& context = scene_context.of(cell.key.variant);
  std::map<int, Image> images;
  try {
    Device device = make_device(cell.backend, options.device);
    Scene scene = context.scene;
    if (group.ignore_effects)
      scene = without_effects(scene, effects_to_ignore(*group.method, scene, group.values, device.info()));
    FrameSource source(scene, *group.method, group.values, device, context.width, context.height);
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

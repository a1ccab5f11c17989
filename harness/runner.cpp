#include "harness/runner.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <thread>
#include <utility>

#include "harness/backend_parity.h"
#include "harness/bad_news.h"
#include "harness/claims.h"
#include "harness/convergence.h"
#include "harness/effect_rows.h"
#include "harness/environment.h"
#include "harness/filter_levels.h"
#include "harness/follow_up.h"
#include "harness/metrics/metrics.h"
#include "harness/progress.h"
#include "harness/resume.h"
#include "harness/run_folder.h"
#include "harness/scene_context.h"
#include "harness/scene_data.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

std::string short_name(const Group& group, const Cell& cell) {
  std::string name = fmt::format("{} {} {}", cell.key.scene, cell.key.method, cell.backend);
  if (group.quality) name += fmt::format(" {}={:g}", group.quality->parameter, group.quality->value);
  if (!cell.key.variant.empty()) name += fmt::format(" ({})", cell.key.variant);
  return name;
}

std::string summary(const Result& result) {
  std::string text = to_string(result.outcome);
  if (result.metrics && result.metrics->frame_wall.stats.count > 0)
    text += fmt::format("  {}", duration_text(result.metrics->frame_wall.stats.median));
  if (result.error) text += fmt::format("  rmse {:.2e}", result.error->worst.rmse);
  if (!result.reason.empty()) text += "  (" + result.reason + ")";
  return text;
}

Result* find(Results& results, const CellKey& key) {
  const auto found = std::find_if(results.results.begin(), results.results.end(),
                                  [&](const Result& result) { return result.key == key; });
  return found == results.results.end() ? nullptr : &*found;
}

constexpr uint64_t kSeed = 1;  // of the order

// What decides where a cell is drawn, as words of the command line, each with a space before it.
std::string global_options(const DeviceOptions& device) {
  std::string out;
  if (device.gl_platform != "osmesa") out += " --gl-platform " + device.gl_platform;
  if (!device.vk_device.empty()) out += fmt::format(" --vk-device '{}'", device.vk_device);
  if (device.threads > 0) out += fmt::format(" --threads {}", device.threads);
  return out;
}

// Each open cell holds a copy of the volume on its Device, which software drivers keep in main memory as well.
bool fit_together(const SceneContext& context, size_t cells) {
  if (cells < 2) return true;
  const auto texels = static_cast<double>(data_of(context.scene).bytes);
  return 4 * texels * static_cast<double>(cells) < 0.25 * static_cast<double>(machine_info().ram_bytes);
}

std::vector<std::string> judged_backends(const Experiment& experiment, const CellFilter& filter) {
  std::vector<std::string> out;
  for (const std::string& backend : experiment.backends)
    if (filter.backends.empty() ||
        std::find(filter.backends.begin(), filter.backends.end(), backend) != filter.backends.end())
      out.push_back(backend);
  return out;
}

class Runner {
 public:
  explicit Runner(const RunOptions& options)
      : options_(options), cache_(options.cache), folder_(options.out), store_(options.out) {
    for (const std::string& name : options.experiments) {
      experiments_.push_back(load_experiment(name));
      Experiment& experiment = experiments_.back();
      if (!options.images) experiment.images = Experiment::Images::None;
      if (!options.references) {  // what is made of errors goes with them
        experiment.references = experiment.attribute = experiment.pairs = false;
        experiment.expect_order_on.clear();
      }
    }
    remarks_ = apply_sweeps(experiments_, options.sweeps, options.filter.methods);
    groups_ = plan_cells(experiments_, options.filter, options.sweeps);
    const std::string globals = global_options(options.cell.device);
    for (Group& group : groups_) {
      group.ignore_effects = options.ignore_effects;
      for (Cell& cell : group.cells) {
        cell.command.insert(std::string("volumark").size(), globals);
        if (options.ignore_effects) cell.command += " --ignore-effects";
        if (!options.references) cell.command += " --no-reference";
      }
    }
  }

  RunOutcome run();

 private:
  std::optional<Results> earlier_results() const;
  void start();
  void describe();
  void run_scene(size_t begin, size_t end, Progress& progress);
  void run_group(const Group& group, const SceneContext& context, Progress& progress);
  void measure(const Group& group, const std::vector<size_t>& cells, const SceneContext& context,
               std::vector<std::map<int, Image>>& images, Progress& progress);
  void keep(Result result, const Group& group, const Cell& cell, Progress& progress);
  bool done_before(const Cell& cell, const Group& group, const SceneContext& context);
  Result died(const Group& group, const Cell& cell, const SceneContext& context) const;
  void compare_backends(const Group& group, const std::string& variant, const std::vector<std::map<int, Image>>& images,
                        Progress& progress);
  void compare_variants(const Group& group, const SceneContext& context,
                        const std::vector<std::map<int, Image>>& images);
  SceneContext scene_context(size_t begin, size_t end);
  void note_backend(const BackendInfo& info);
  void sort_results();

  const RunOptions& options_;
  ReferenceCache cache_;
  std::vector<Experiment> experiments_;
  std::vector<std::string> remarks_;
  std::vector<Group> groups_;
  RunFolder folder_;
  PictureStore store_;
  FollowUp* follow_up_ = nullptr;  // of the scene that is being run
  RunOutcome out_;
};

// A results.json that cannot be read stands in the way of everything but --overwrite.
std::optional<Results> Runner::earlier_results() const {
  try {
    return folder_.earlier();
  } catch (const ResultsError& error) {
    if (options_.overwrite && !options_.resume) return std::nullopt;
    throw ResultsError(
        fmt::format("{}; choose another folder with --out, or replace it with --overwrite", error.what()));
  }
}

void Runner::start() {
  std::optional<Results> earlier = earlier_results();
  const GitInfo git = git_info();
  if (earlier && !options_.resume && !options_.overwrite) {
    const bool finished = !earlier->run.finished_at.empty();
    throw FolderError(fmt::format("{}: holds {} run of {} cells: {}, or replace it with --overwrite",
                                  folder_.path().string(), finished ? "a finished" : "an unfinished",
                                  earlier->results.size(),
                                  finished ? "choose another folder with --out" : "go on with --resume"));
  }
  if (earlier && options_.resume) {
    if (const std::string differs = resume_differences(*earlier, options_, experiments_); !differs.empty())
      throw FolderError(
          fmt::format("{}: its run cannot be gone on with, since figures depend on what differs: {}; choose another "
                      "folder with --out, or replace the run with --overwrite",
                      folder_.path().string(), differs));
    out_.results = std::move(*earlier);
    ++out_.results.run.resumed;
    out_.results.run.interrupted = false;
    out_.results.run.finished_at.clear();
    return;
  }
  Results& results = out_.results;
  results.run.started_at = utc_now();
  results.run.id = results.run.started_at + "-" + std::to_string(::getpid());
  results.run.argv = options_.argv;
  results.run.order =
      "scene by scene; within a scene, method and parameters shuffled with the seed; backends and variants pass by "
      "pass in turn; "
      "views "
      "in turn within a pass, each pass one view further";
  results.run.seed = kSeed;
  results.run.device = deciding_options(options_, experiments_);
  for (const Sweep& sweep : options_.sweeps) results.run.sweeps.push_back(to_string(sweep));
  results.git = git;
  results.build = build_info();
  results.machine = machine_info();
}

void Runner::describe() {
  Results& results = out_.results;
  results.experiments.clear();
  for (const Experiment& experiment : experiments_) {
    ExperimentResultInfo info{experiment.name, experiment.title, experiment.description, experiment.limits};
    for (const auto& [metric, limit] : experiment.finest_limits) info.limits["finest_" + metric] = limit;
    if (experiment.parity > 0) info.limits["parity"] = experiment.parity;
    results.experiments.push_back(std::move(info));
    for (const ExperimentMethod& entry : experiment.methods) {
      const MethodInfo& method = entry.method->info();
      if (std::any_of(results.methods.begin(), results.methods.end(),
                      [&](const auto& m) { return m.name == method.name; }))
        continue;
      MethodResultInfo described{method.name, method.title, method.paper, {}};
      for (const ParameterInfo& parameter : method.parameters)
        described.parameters.push_back({parameter.name, parameter.unit, parameter.doc, parameter.quality_axis});
      results.methods.push_back(std::move(described));
    }
  }
  results.self_test.clear();
  for (const SelfTest& row : metric_self_test())
    results.self_test.push_back({"metric", row.name, "", row.expected, row.measured, row.tolerance, row.pass()});
}

void Runner::note_backend(const BackendInfo& info) {
  for (const BackendResultInfo& known : out_.results.backends)
    if (known.id == info.id) return;
  BackendResultInfo& added = out_.results.backends.emplace_back(backend_result_info(info));
  try {
    Device device = make_device(info.id, options_.cell.device);
    added.filter_levels = measure_filter_levels(device);
  } catch (const DeviceError&) {  // it can draw cells all the same: the figure stays unknown
  }
}

bool Runner::done_before(const Cell& cell, const Group& group, const SceneContext& context) {
  const Result* old = find(out_.results, cell.key);
  return old != nullptr && old->case_version == case_version(group, cell, context);
}

Result Runner::died(const Group& group, const Cell& cell, const SceneContext& context) const {
  Result result;
  result.key = cell.key;
  result.case_version = case_version(group, cell, context);
  result.outcome = Outcome::Failed;
  result.reason = "the process died twice while it measured this cell";
  result.effects = effect_names(context.of(cell.key.variant).scene.effects);
  result.width = context.width;
  result.height = context.height;
  result.quality = group.quality;
  result.command = cell.command;
  result.finished_at = utc_now();
  return result;
}

void Runner::keep(Result result, const Group& group, const Cell& cell, Progress& progress) {
  folder_.end_cell(result);
  progress.cell(short_name(group, cell), summary(result));
  if (Result* old = find(out_.results, cell.key))
    *old = std::move(result);
  else
    out_.results.results.push_back(std::move(result));
  folder_.save(out_.results, false);
}

// Cells that are open together, pass by pass in turn: a drift of the machine meets all of them alike.
void Runner::measure(const Group& group, const std::vector<size_t>& cells, const SceneContext& context,
                     std::vector<std::map<int, Image>>& images, Progress& progress) {
  std::vector<std::unique_ptr<CellRun>> open;
  const int64_t empty = resident_bytes();
  try {
    for (const size_t i : cells) {
      folder_.begin_cell(group.cells[i].key);
      open.push_back(std::make_unique<CellRun>(group, group.cells[i], context, options_.cell));
      const int64_t others = resident_bytes() - empty;
      open.back()->open();
      open.back()->held_by_others(others);
    }
    // Workers of the last backend wait a moment for more work before they sleep: that is not the next one's time.
    std::vector<CellRun*> running;
    for (const auto& cell : open) running.push_back(cell.get());
    while (!running.empty())
      std::erase_if(running, [&](CellRun* cell) {
        if (open.size() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return !cell->pass();
      });
  } catch (const Interrupted&) {
    for (size_t k = 0; k < open.size(); ++k) folder_.drop_cell(group.cells[cells[k]].key);
    throw;
  }
  for (size_t k = 0; k < open.size(); ++k) {
    Result result = open[k]->finish(store_);
    images[cells[k]] = open[k]->images();
    if (open[k]->backend()) note_backend(*open[k]->backend());
    open[k].reset();
    keep(std::move(result), group, group.cells[cells[k]], progress);
    follow_up_->measured(group.cells[cells[k]], images[cells[k]]);
  }
}

void Runner::run_group(const Group& group, const SceneContext& context, Progress& progress) {
  std::vector<std::map<int, Image>> images(group.cells.size());
  std::vector<bool> before(group.cells.size());
  std::vector<size_t> together;
  std::vector<std::vector<size_t>> alone;
  for (size_t i = 0; i < group.cells.size(); ++i) {
    const Cell& cell = group.cells[i];
    if (options_.resume && done_before(cell, group, context)) {
      before[i] = true;
      ++out_.skipped;
      progress.skip();
      continue;
    }
    const auto deaths = folder_.died_in().find(key_text(cell.key));
    const int died_before = options_.resume && deaths != folder_.died_in().end() ? deaths->second : 0;
    if (died_before >= 2)
      keep(died(group, cell, context), group, cell, progress);
    else if (died_before == 1)
      alone.push_back({i});  // so that a second death tells which of them it was
    else
      together.push_back(i);
  }
  if (!fit_together(context, together.size())) {
    for (const size_t i : together) alone.push_back({i});
    together.clear();
  }
  if (!together.empty()) measure(group, together, context, images, progress);
  for (const std::vector<size_t>& one : alone) measure(group, one, context, images, progress);
  const bool compares = compares_backends(group) || group.experiment->effects;
  if (!compares || std::all_of(before.begin(), before.end(), [](bool b) { return b; })) return;
  for (size_t i = 0; i < group.cells.size(); ++i) {
    const Result* old = before[i] ? find(out_.results, group.cells[i].key) : nullptr;
    if (old != nullptr && old->metrics) images[i] = draw_cell(group, group.cells[i], context, options_.cell);
  }
  if (compares_backends(group)) {
    std::set<std::string> variants;
    for (const Cell& cell : group.cells) variants.insert(cell.key.variant);
    for (const std::string& variant : variants) compare_backends(group, variant, images, progress);
  }
  if (group.experiment->effects) compare_variants(group, context, images);
}

// What each effect costs, from the cells of a group that were measured in turns.
void Runner::compare_variants(const Group& group, const SceneContext& context,
                              const std::vector<std::map<int, Image>>& images) {
  std::map<std::string, std::vector<VariantCell>> by_backend;
  for (size_t i = 0; i < group.cells.size(); ++i)
    if (const Result* result = find(out_.results, group.cells[i].key))
      by_backend[group.cells[i].backend].push_back({result, &images[i]});
  for (const auto& [unused, cells] : by_backend)
    for (EffectRow& row : effect_rows(context.scene, cells)) {
      std::erase_if(out_.results.effects, [&](const EffectRow& old) {
        return old.key == row.key && old.effect == row.effect && old.mode == row.mode;
      });
      out_.results.effects.push_back(std::move(row));
    }
}

void Runner::compare_backends(const Group& group, const std::string& variant,
                              const std::vector<std::map<int, Image>>& images, Progress& progress) {
  for (ParityRow& row : backend_parity(group, variant, images)) {
    std::erase_if(out_.results.parity, [&](const ParityRow& old) {
      return old.key == row.key && old.other == row.other && old.view == row.view;
    });
    if (!row.ok)
      progress.line(
          fmt::format("      {} and {} differ by {:.2e} in {} interior pixels, and above the limit in {} of {} at "
                      "silhouettes (view {}, limit {:g})",
                      row.key.backend, row.other, row.interior_max, row.interior_over, row.silhouette_over,
                      row.silhouette_pixels, row.view, row.limit));
    out_.results.parity.push_back(std::move(row));
  }
}

// The scene of these groups, in every variant that their cells ask for.
SceneContext Runner::scene_context(size_t begin, size_t end) {
  SceneContext context = make_context(*groups_[begin].experiment, groups_[begin].scene, options_.data);
  for (size_t i = begin; i < end; ++i)
    for (const Cell& cell : groups_[i].cells) {
      const std::string& variant = cell.key.variant;
      if (!variant.empty() && !context.variants.contains(variant))
        context.variants[variant] = variant_context(context, variant);
    }
  return context;
}

void Runner::run_scene(size_t begin, size_t end, Progress& progress) {
  const Group& group = groups_[begin];
  SceneContext context = scene_context(begin, end);
  FollowUp follow_up(std::span<const Group>(groups_).subspan(begin, end - begin), experiments_, out_.results);
  follow_up_ = &follow_up;
  bool all_before = options_.resume && follow_up.complete();
  for (size_t i = begin; i < end && all_before; ++i)
    for (const Cell& cell : groups_[i].cells) all_before = all_before && done_before(cell, groups_[i], context);
  if (all_before) {
    for (size_t i = begin; i < end; ++i)
      for ([[maybe_unused]] const Cell& cell : groups_[i].cells) {
        ++out_.skipped;
        progress.skip();
      }
    return;
  }
  // When the first cell is about to draw: a scene that no method can draw costs no reference.
  const auto later = [&](SceneContext& wanting) {
    wanting.want_references = [this, &wanting, &group, &progress, made = false]() mutable {
      if (std::exchange(made, true)) return;
      make_references(wanting, *group.experiment, cache_, store_, options_.cell.device.threads, options_.cell.stop,
                      progress);
    };
  };
  later(context);
  for (const auto& [unused, variant] : context.variants) later(*variant);
  std::erase_if(out_.results.scenes, [&](const SceneResultInfo& info) { return info.name == context.scene.name; });
  out_.results.scenes.push_back(scene_result_info(context.scene));
  // Neighbouring settings are not measured one after another either.
  std::vector<size_t> order(end - begin);
  std::iota(order.begin(), order.end(), begin);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(kSeed));
  for (const size_t i : order) run_group(groups_[i], context, progress);
  follow_up.run(context, options_.cell, progress);
  folder_.save(out_.results, false);
}

// Results in the order of the plan, whatever the order they were measured in; those of no cell of the plan come last.
void Runner::sort_results() {
  std::map<std::string, size_t> place;
  for (const Group& group : groups_)
    for (const Cell& cell : group.cells) place.emplace(key_text(cell.key), place.size());
  std::vector<std::pair<size_t, Result>> sorted;
  for (Result& result : out_.results.results) {
    const auto found = place.find(key_text(result.key));
    sorted.emplace_back(found == place.end() ? place.size() : found->second, std::move(result));
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (size_t i = 0; i < sorted.size(); ++i) out_.results.results[i] = std::move(sorted[i].second);
  std::stable_sort(out_.results.effects.begin(), out_.results.effects.end(),
                   [&](const EffectRow& a, const EffectRow& b) {
                     const auto at = [&](const EffectRow& row) {
                       const auto found = place.find(key_text(row.key));
                       return found == place.end() ? place.size() : found->second;
                     };
                     return at(a) < at(b);
                   });
}

RunOutcome Runner::run() {
  for (const Group& group : groups_) load_scene(group.scene);  // a broken scene file is an error before any work
  start();
  describe();
  size_t cells = 0;
  for (const Group& group : groups_) cells += group.cells.size();
  folder_.save(out_.results, true);
  {
    Progress progress(options_.progress, cells);
    for (const std::string& remark : remarks_) progress.line(remark);
    try {
      for (size_t begin = 0, end = 0; begin < groups_.size(); begin = end) {
        while (end < groups_.size() && groups_[end].scene == groups_[begin].scene &&
               groups_[end].experiment == groups_[begin].experiment)
          ++end;
        run_scene(begin, end, progress);
      }
    } catch (const Interrupted&) {
      out_.interrupted = true;
    }
  }
  sort_results();
  fit_convergence(out_.results, experiments_);
  explain_floors(out_.results);
  for (const Experiment& experiment : experiments_)
    judge_claims(out_.results, experiment.claims, experiment.name, judged_backends(experiment, options_.filter));
  out_.results.run.interrupted = out_.interrupted;
  if (!out_.interrupted) out_.results.run.finished_at = utc_now();
  out_.results.machine.load_after = load_average();
  folder_.save(out_.results, true);
  out_.bad_news = bad_news_of(out_.results);
  return std::move(out_);
}

}  // namespace

RunOutcome run_experiments(const RunOptions& options) { return Runner(options).run(); }

}  // namespace volumark

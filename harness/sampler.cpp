#include "harness/sampler.h"

#include <fmt/format.h>

#include "harness/environment.h"
#include "harness/statistics.h"

namespace volumark {
namespace {

std::vector<double> of_view(const Metric& metric, int64_t view) {
  std::vector<double> out;
  for (size_t i = 0; i < metric.samples.size(); ++i)
    if (metric.views[i] == view) out.push_back(metric.samples[i]);
  return out;
}

void set_stats(Metric& metric) { metric.stats = stats_of(metric.samples, metric.views); }

}  // namespace

FrameSampler::FrameSampler(const Experiment& experiment, const SceneContext& context, const std::atomic<bool>* stop)
    : experiment_(experiment), context_(context), stop_(stop), started_(now()) {}

void FrameSampler::check_limits() const {
  if (stop_ != nullptr && stop_->load()) throw Interrupted{};
  const double spent = since(started_).wall;
  if (spent > experiment_.timeout)
    throw TimedOut{fmt::format("{:.3g} s were spent, the limit of a cell is {:g} s", spent, experiment_.timeout)};
}

void FrameSampler::add(const FrameCost& frame, int view) {
  const auto put = [view](Metric& metric, double value) {
    metric.samples.push_back(value);
    metric.views.push_back(view);
  };
  put(metrics_.frame_wall, frame.cost.wall);
  put(metrics_.frame_cpu, frame.cost.cpu);
  std::map<std::string, double> zones;  // a zone may come several times in a frame
  for (const ZoneTime& zone : frame.zones) zones[zone.name] += zone.seconds;
  for (const auto& [name, seconds] : zones) put(metrics_.zones[name], seconds);
}

void FrameSampler::first_pass(FrameSource& source, Result& result, std::map<int, Image>& images) {
  for (const int view : context_.views) {
    const FrameCost frame = source.frame(context_.scene.views[static_cast<size_t>(view)]);
    if (!metrics_.frame_wall.first) {
      metrics_.frame_wall.first = frame.cost.wall;
      metrics_.frame_cpu.first = frame.cost.cpu;
    }
    drawn_ = true;
    images[view] = source.read_back();
    ViewResult entry;
    entry.index = view;
    entry.name = context_.scene.views[static_cast<size_t>(view)].name;
    const Counters counters = source.counters();
    entry.counters.insert(counters.begin(), counters.end());
    result.views.push_back(std::move(entry));
    check_limits();
  }
}

bool FrameSampler::precise() const {
  const Metric& wall = metrics_.frame_wall;
  const Interval interval = bootstrap_median(wall.samples, wall.views);
  return interval.hi - interval.lo <= experiment_.precision * median(wall.samples);
}

void FrameSampler::timed_passes(FrameSource& source) {
  metrics_.timing.precision = experiment_.precision;
  metrics_.timing.budget = experiment_.budget;
  metrics_.timing.stopped = "count";
  const Instant start = now();
  int next_check = experiment_.least;
  for (int pass = 1; pass <= experiment_.most; ++pass) {
    for (const int view : context_.views) {
      add(source.frame(context_.scene.views[static_cast<size_t>(view)]), view);
      check_limits();
    }
    if (pass < experiment_.least) continue;
    if (since(start).wall >= experiment_.budget) {
      metrics_.timing.stopped = "budget";
      return;
    }
    if (pass >= next_check) {
      if (precise()) {
        metrics_.timing.stopped = "precision";
        return;
      }
      next_check = pass + std::max(1, pass / 4);  // the test costs time too
    }
  }
}

void FrameSampler::run(const Method& method, const Values& values, Device& device, Result& result,
                       std::map<int, Image>& images) {
  FrameSource source(context_.scene, method, values, device, context_.width, context_.height);
  metrics_.prepare.wall = source.prepare_cost().cost.wall;
  metrics_.prepare.cpu = source.prepare_cost().cost.cpu;
  for (const ZoneTime& zone : source.prepare_cost().zones) metrics_.prepare.zones[zone.name] += zone.seconds;
  check_limits();
  first_pass(source, result, images);
  timed_passes(source);
  metrics_.peak_bytes.device = static_cast<int64_t>(device.peak_bytes());
  metrics_.peak_bytes.process = peak_resident_bytes();
  metrics_.peak_bytes.voxels = static_cast<int64_t>(context_.scene.volume->voxels.size());
  metrics_.peak_bytes.target = static_cast<int64_t>(source.target_bytes());
  finish(result);
}

void FrameSampler::finish(Result& result) const {
  if (!drawn_) return;
  Metrics out = metrics_;
  if (out.timing.stopped.empty()) out.timing.stopped = "budget";
  set_stats(out.frame_wall);
  set_stats(out.frame_cpu);
  for (auto& [unused, zone] : out.zones) set_stats(zone);
  for (ViewResult& view : result.views) {
    if (const auto wall = of_view(out.frame_wall, view.index); !wall.empty()) view.frame_wall = stats_of(wall);
    if (const auto cpu = of_view(out.frame_cpu, view.index); !cpu.empty()) view.frame_cpu = stats_of(cpu);
    for (const auto& [name, count] : view.counters)
      out.counters[name] += static_cast<double>(count) / static_cast<double>(result.views.size());
  }
  result.metrics = std::move(out);
}

}  // namespace volumark

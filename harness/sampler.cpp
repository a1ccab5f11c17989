#include "harness/sampler.h"

#include <fmt/format.h>

#include "harness/environment.h"
#include "harness/scene_data.h"
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
    : experiment_(experiment), context_(context), stop_(stop) {}

void FrameSampler::check_limits() const {
  if (stop_ != nullptr && stop_->load()) throw Interrupted{};
  const double spent = spent_ + since(entered_).wall;
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

void FrameSampler::first_frames(Result& result, std::map<int, Image>& images) {
  for (const int view : context_.views) {
    const FrameCost frame = source_->frame(context_.scene.views[static_cast<size_t>(view)]);
    if (!metrics_.frame_wall.first) {
      metrics_.frame_wall.first = frame.cost.wall;
      metrics_.frame_cpu.first = frame.cost.cpu;
    }
    drawn_ = true;
    images[view] = source_->read_back();
    ViewResult entry;
    entry.index = view;
    entry.name = context_.scene.views[static_cast<size_t>(view)].name;
    const Counters counters = source_->counters();
    entry.counters.insert(counters.begin(), counters.end());
    result.views.push_back(std::move(entry));
    check_limits();
  }
}

void FrameSampler::begin(const Scene& scene, const Method& method, const Values& values, Device& device, Result& result,
                         std::map<int, Image>& images) {
  entered_ = now();
  source_.emplace(scene, method, values, device, context_.width, context_.height);
  metrics_.prepare.wall = source_->prepare_cost().cost.wall;
  metrics_.prepare.cpu = source_->prepare_cost().cost.cpu;
  for (const ZoneTime& zone : source_->prepare_cost().zones) metrics_.prepare.zones[zone.name] += zone.seconds;
  metrics_.timing.precision = experiment_.precision;
  metrics_.timing.budget = experiment_.budget;
  check_limits();
  first_frames(result, images);
  metrics_.peak_bytes.device = static_cast<int64_t>(device.peak_bytes());
  metrics_.peak_bytes.process = peak_resident_bytes();
  metrics_.peak_bytes.voxels = data_of(context_.scene).bytes;
  metrics_.peak_bytes.target = static_cast<int64_t>(source_->target_bytes());
  next_check_ = std::max(experiment_.least, 3);  // fewer samples a view have no interval worth the name
  spent_ += since(entered_).wall;
}

bool FrameSampler::precise() const {
  const Metric& wall = metrics_.frame_wall;
  const Interval interval = bootstrap_typical(wall.samples, wall.views);
  return interval.hi - interval.lo <= experiment_.precision * typical(wall.samples, wall.views);
}

// Each pass starts one view further: the first frame after a change of cell finds cold caches, and that is not one
// view's burden alone.
bool FrameSampler::pass() {
  entered_ = now();
  const size_t views = context_.views.size();
  for (size_t i = 0; i < views; ++i) {
    const int view = context_.views[(i + static_cast<size_t>(passes_)) % views];
    add(source_->frame(context_.scene.views[static_cast<size_t>(view)]), view);
    check_limits();
  }
  const double seconds = since(entered_).wall;
  spent_ += seconds;
  sampled_ += seconds;
  ++passes_;
  const auto stop = [this](const char* why) {
    metrics_.timing.stopped = why;
    return false;
  };
  if (passes_ >= experiment_.least) {
    if (sampled_ >= experiment_.budget) return stop("budget");
    if (passes_ >= next_check_) {
      if (precise()) return stop("precision");
      next_check_ = passes_ + std::max(1, passes_ / 4);  // the test costs time too
    }
  }
  return passes_ < experiment_.most || stop("count");
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

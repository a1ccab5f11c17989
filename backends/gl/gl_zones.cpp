#include "backends/gl/gl_zones.h"

namespace volumark {

void GlZones::finish() {
  if (!pending_work_) return;
  gl_.Finish();
  pending_work_ = false;
}

GlZones::Stamp GlZones::stamp() {
  Stamp result;
  if (gpu_timers_) {
    if (used_queries_ == queries_.size()) {
      queries_.push_back(0);
      gl_.CreateQueries(GL_TIMESTAMP, 1, &queries_.back());
    }
    result.query = queries_[used_queries_++];
    gl_.QueryCounter(result.query, GL_TIMESTAMP);
    pending_work_ = true;
  } else {
    finish();
    result.wall = Clock::now();
  }
  return result;
}

void GlZones::begin(const std::string& name) {
  open_.push_back(zones_.size());
  zones_.push_back({name, {}, {}});
  zones_.back().begin = stamp();
}

void GlZones::end() {
  zones_[open_.back()].end = stamp();
  open_.pop_back();
}

double GlZones::seconds(const Zone& zone) const {
  if (!gpu_timers_) return std::chrono::duration<double>(zone.end.wall - zone.begin.wall).count();
  GLuint64 from = 0, to = 0;
  gl_.GetQueryObjectui64v(zone.begin.query, GL_QUERY_RESULT, &from);
  gl_.GetQueryObjectui64v(zone.end.query, GL_QUERY_RESULT, &to);
  return static_cast<double>(to - from) * 1e-9;
}

std::vector<ZoneTime> GlZones::take() {
  while (!open_.empty()) end();  // Device refuses this; a zone without its end would be garbage
  std::vector<ZoneTime> result;
  result.reserve(zones_.size());
  for (const Zone& zone : zones_) result.push_back({zone.name, seconds(zone)});
  zones_.clear();
  used_queries_ = 0;
  return result;
}

}  // namespace volumark

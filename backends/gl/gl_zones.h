// Times zones: on a GPU with timestamp queries, on a software renderer with the wall clock around glFinish (Mesa's
// llvmpipe answers GL_TIME_ELAPSED wrongly: it times the binning, not the rasterising). Costs nothing without zones.
#pragma once

#include <chrono>
#include <vector>

#include "backends/gl/gl_functions.h"
#include "backends/types.h"

namespace volumark {

class GlZones {
 public:
  GlZones(const GlFunctions& gl, bool gpu_timers) : gl_(gl), gpu_timers_(gpu_timers) {}

  void begin(const std::string& name);
  void end();
  // Work has been given to the driver since the last finish.
  void note_work() { pending_work_ = true; }
  void finish();
  // After finish(); forgets the zones.
  std::vector<ZoneTime> take();

 private:
  using Clock = std::chrono::steady_clock;
  struct Stamp {
    Clock::time_point wall;
    GLuint query = 0;
  };
  struct Zone {
    std::string name;
    Stamp begin, end;
  };
  Stamp stamp();
  double seconds(const Zone& zone) const;

  const GlFunctions& gl_;
  bool gpu_timers_;
  bool pending_work_ = false;
  std::vector<Zone> zones_;
  std::vector<size_t> open_;
  std::vector<GLuint> queries_;  // made once, used again in every submission
  size_t used_queries_ = 0;
};

}  // namespace volumark

// The two clocks of a frame.
#pragma once

#include <chrono>
#include <ctime>

namespace volumark {

struct Instant {
  double wall = 0, cpu = 0;  // seconds; cpu: of all threads of this process
};

inline Instant now() {
  timespec cpu{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(wall).count(),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

inline Instant since(const Instant& start) {
  const Instant end = now();
  return {end.wall - start.wall, end.cpu - start.cpu};
}

}  // namespace volumark

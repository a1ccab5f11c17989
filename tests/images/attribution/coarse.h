// Whether the drivers were asked to filter as Mesa does by default: bytes in 8-bit integers.
#pragma once

#include <cstdlib>
#include <string>

#include "tests/support/backend.h"

namespace volumark {

inline bool filters_coarsely() {
  const char* set = std::getenv("GALLIVM_PERF");
  return backend_id() != "cpu" && set != nullptr && std::string(set).find("no_aos_sampling") == std::string::npos;
}

}  // namespace volumark

// A backend around another one that counts what goes through it: the example of CONTRIBUTING.md's checklist "add a
// backend". It draws exactly what the inner one draws.
#pragma once

#include <memory>

#include "backends/backend.h"

namespace volumark {

struct BackendCounts {
  int64_t draws = 0, vertices = 0, passes = 0, submissions = 0;
  size_t uploaded = 0, read_back = 0;  // bytes
};

// `counts` must outlive the backend.
std::unique_ptr<Backend> make_counting_backend(std::unique_ptr<Backend> inner, BackendCounts& counts);

}  // namespace volumark

// The stability suite's integrator (harness/verify/brute_force.h), under the tests' namespace.
#pragma once

#include "harness/verify/brute_force.h"

namespace volumark::test {
using namespace brute;  // NOLINT: the tests read as they did
}

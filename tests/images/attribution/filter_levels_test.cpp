// How finely each backend filters is measured, and is what its driver is known for.
#include "harness/filter_levels.h"

#include <gtest/gtest.h>

#include "backends/backend.h"
#include "tests/images/attribution/coarse.h"

namespace volumark {
namespace {

TEST(FilterLevels, AreWhatTheDriverIsKnownFor) {
  const bool coarse = filters_coarsely();  // asked before the backend sets the variable
  Device device = make_device(backend_id(), device_options());
  if (!device.info().software) GTEST_SKIP() << "known of software drivers alone";
  const size_t before = device.live_bytes();
  const auto levels = measure_filter_levels(device);
  EXPECT_EQ(device.live_bytes(), before) << "something was left alive";
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_EQ(levels.at("r8"), coarse ? 256 : kFilterPlaces);
  for (const char* format : {"r16", "r16f", "r32f"}) EXPECT_EQ(levels.at(format), kFilterPlaces) << format;
}

TEST(FilterLevels, RepeatThemselves) {
  Device device = make_device(backend_id(), device_options());
  EXPECT_EQ(measure_filter_levels(device), measure_filter_levels(device));
}

}  // namespace
}  // namespace volumark

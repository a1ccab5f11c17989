// What holds for Device without a driver: handles, counts, refusals (each on a live backend: conformance), the list.
#include "backends/device.h"

#include <gtest/gtest.h>

#include "backends/slot_table.h"

namespace volumark {
namespace {

TEST(DeviceList, NamesFourBackendsAndRefusesOthers) {
  std::string ids;
  for (const BackendEntry& entry : backend_list()) ids += std::string(entry.id) + ' ';
  EXPECT_EQ(ids, "gl vulkan cpu null ");
  try {
    make_device("metal");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("known are gl, vulkan, cpu, null"), std::string::npos) << error.what();
  }
}

TEST(DeviceErrors, NameCallLabelAndKind) {
  Device device = make_device("null");
  try {
    device.create_buffer({.label = "vertices", .size = 0, .data = {}});
    ADD_FAILURE();
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.kind, DeviceErrorKind::BadArgument);
    EXPECT_EQ(error.call, "create_buffer");
    EXPECT_EQ(error.label, "vertices");
    EXPECT_EQ(std::string(error.what()), "create_buffer('vertices'): bad argument: size is 0");
  }
}

TEST(NullBackend, ClearsAndReadsBack) {
  Device device = make_device("null");
  const Texture target =
      device.create_texture({.label = "target", .format = Format::RGBA8, .width = 2, .height = 2, .target = true});
  device.begin_pass({.label = "clear", .colour = target, .colour_value = {1, 0, 0, 1}});
  device.end_pass();
  const auto bytes = device.read_texture(target);
  for (size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], std::byte(i % 4 == 0 || i % 4 == 3 ? 255 : 0));
}

struct Tag;

TEST(SlotTable, ReusesSlotsUnderNewGenerationsAndSurvivesAThrow) {
  SlotTable<Handle<Tag>, int> table;
  const auto nothing = [](uint32_t) {};
  const auto first = table.insert(1, nothing);
  EXPECT_THROW(table.insert(2, [](uint32_t) { throw 0; }), int);
  const auto second = table.insert(2, nothing);
  EXPECT_EQ(*table.find(first), 1);
  EXPECT_EQ(*table.find(second), 2);
  table.erase(first);
  EXPECT_EQ(table.find(first), nullptr);
  const auto third = table.insert(3, nothing);
  EXPECT_EQ(third.index, first.index);
  EXPECT_NE(third.generation, first.generation);
  EXPECT_EQ(table.find(first), nullptr);
  EXPECT_EQ(table.all().size(), 2u);
  EXPECT_EQ(table.find({}), nullptr);
}

}  // namespace
}  // namespace volumark

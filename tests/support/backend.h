// Tests that run once a backend: the one named on the command line (vm_backend_test in tests/CMakeLists.txt registers
// all three). A backend that cannot be had is a failure, never a skip.
#pragma once

#include <string>

#include "backends/device.h"

namespace volumark {

const std::string& backend_id();
DeviceOptions device_options();  // validation layers on for vulkan; --gl-platform and --vk-device

}  // namespace volumark

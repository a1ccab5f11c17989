// TEST --backend=gl|vulkan|cpu [--gl-platform=egl] [--vk-device=NAME] [GoogleTest flags]
#include <gtest/gtest.h>

#include <cstdio>
#include <string_view>

#include "tests/support/backend.h"

namespace volumark {
namespace {

std::string backend;
DeviceOptions options;

bool take(std::string_view argument, std::string_view flag, std::string& into) {
  if (!argument.starts_with(flag)) return false;
  into = argument.substr(flag.size());
  return true;
}

int run(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (take(argument, "--backend=", backend) || take(argument, "--gl-platform=", options.gl_platform) ||
        take(argument, "--vk-device=", options.vk_device)) {
      continue;
    }
    std::fprintf(stderr, "unknown argument %s\n", argv[i]);
    return 2;
  }
  if (backend.empty() && !GTEST_FLAG_GET(list_tests)) {
    std::fprintf(stderr, "--backend=gl, vulkan or cpu is wanted\n");
    return 2;
  }
  options.validation = backend == "vulkan";
  return RUN_ALL_TESTS();
}

}  // namespace

const std::string& backend_id() { return backend; }
DeviceOptions device_options() { return options; }

}  // namespace volumark

int main(int argc, char** argv) { return volumark::run(argc, argv); }

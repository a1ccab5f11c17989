#include "tests/effects/stripped_text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace volumark {

namespace fs = std::filesystem;

std::string glsl_without(const ShaderText& text, const std::vector<std::string>& effects) {
  std::string defines;
  for (std::string effect : effects) {
    std::transform(effect.begin(), effect.end(), effect.begin(), [](unsigned char c) { return std::toupper(c); });
    defines += "#define VM_WITHOUT_" + effect + "\n";
  }
  std::string glsl = text.glsl;
  return glsl.insert(glsl.find('\n') + 1, defines);
}

std::vector<uint32_t> spirv_without(const ShaderText& text, const std::vector<std::string>& effects) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("volumark-stripped-{}", ::getpid());
  fs::create_directories(folder);
  constexpr const char* kSuffix[] = {"vert", "geom", "frag", "comp"};
  const fs::path source = folder / fmt::format("program.{}", kSuffix[static_cast<size_t>(text.stage)]);
  const fs::path binary = folder / "program.spv";
  std::ofstream(source) << glsl_without(text, effects);
  const std::string command =
      fmt::format("{} -V --target-env vulkan1.3 --quiet -o {} {}", VM_GLSLANG, binary.string(), source.string());
  const int status = std::system(command.c_str());
  std::ifstream stream(binary, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  fs::remove_all(folder);
  if (status != 0 || bytes.empty()) throw std::runtime_error(fmt::format("failed: {}", command));
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
  return words;
}

}  // namespace volumark

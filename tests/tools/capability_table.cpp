// capability_table --write FILE | --check FILE: the table of what each backend can do, made from the live backends,
// between the two marks in FILE. --check exits 1 where the file differs from the code.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string_view>

#include "backends/device.h"

namespace volumark {
namespace {

constexpr std::string_view kBegin = "<!-- capability table: begin (made by capability_table --write) -->\n";
constexpr std::string_view kEnd = "<!-- capability table: end -->\n";
constexpr std::array kBackends = {"gl", "vulkan", "cpu"};

std::string cell(const BackendInfo& info, Capability capability) {
  if (std::ranges::find(info.capabilities, capability) != info.capabilities.end()) return "yes";
  for (const auto& [absent, why] : info.absent) {
    if (absent == capability) return "no: " + why;
  }
  return "no";
}

std::string table() {
  std::vector<BackendInfo> infos;
  for (const char* id : kBackends) infos.push_back(make_device(id).info());
  std::string out = "| |";
  for (const BackendInfo& info : infos) out += fmt::format(" {} |", info.id);
  out += "\n| --- |";
  for (size_t i = 0; i < infos.size(); ++i) out += " --- |";
  out += "\n";
  const auto row = [&](std::string_view name, auto&& text) {
    out += fmt::format("| {} |", name);
    for (const BackendInfo& info : infos) out += fmt::format(" {} |", text(info));
    out += "\n";
  };
  for (const Capability capability : kAllCapabilities) {
    row(to_string(capability), [&](const BackendInfo& info) { return cell(info, capability); });
  }
  row("largest 1D texture", [](const BackendInfo& info) { return std::to_string(info.limits.texture_1d); });
  row("largest 2D texture", [](const BackendInfo& info) { return std::to_string(info.limits.texture_2d); });
  row("largest 3D texture", [](const BackendInfo& info) { return std::to_string(info.limits.texture_3d); });
  row("largest buffer binding, MiB",
      [](const BackendInfo& info) { return std::to_string(info.limits.storage_buffer_bytes >> 20); });
  return out;
}

int run(std::string_view mode, const char* path) {
  std::stringstream content;
  content << std::ifstream(path).rdbuf();
  std::string text = content.str();
  const size_t begin = text.find(kBegin), end = text.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    fmt::print(stderr, "{}: the marks of the table are missing\n", path);
    return 2;
  }
  const size_t from = begin + kBegin.size();
  const std::string wanted = table();
  if (text.compare(from, end - from, wanted) == 0) return 0;
  if (mode == "--check") {
    fmt::print(stderr, "{} is not what the backends say; renew it with capability_table --write\n{}", path, wanted);
    return 1;
  }
  text.replace(from, end - from, wanted);
  std::ofstream(path) << text;
  return 0;
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  if (argc != 3 || (std::string_view(argv[1]) != "--write" && std::string_view(argv[1]) != "--check")) {
    std::fprintf(stderr, "usage: capability_table --write|--check FILE\n");
    return 2;
  }
  return volumark::run(argv[1], argv[2]);
}

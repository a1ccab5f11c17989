#include "harness/environment.h"

#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "volumark_build.h"
#include "volumark_git.h"

namespace volumark {
namespace {

// Variables that change drivers, threads or what is measured.
constexpr const char* kDriverVariables[] = {"LP_NUM_THREADS",
                                            "LP_NATIVE_VECTOR_WIDTH",
                                            "LP_PERF",
                                            "GALLIUM_DRIVER",
                                            "GALLIVM_PERF",
                                            "GALLIVM_DEBUG",
                                            "MESA_SHADER_CACHE_DISABLE",
                                            "MESA_GL_VERSION_OVERRIDE",
                                            "MESA_LOADER_DRIVER_OVERRIDE",
                                            "MESA_NO_ERROR",
                                            "LIBGL_ALWAYS_SOFTWARE",
                                            "EGL_PLATFORM",
                                            "VK_ICD_FILENAMES",
                                            "VK_DRIVER_FILES",
                                            "VK_LOADER_DRIVERS_SELECT",
                                            "VK_LAYER_PATH",
                                            "VK_INSTANCE_LAYERS",
                                            "OMP_NUM_THREADS",
                                            "LD_PRELOAD",
                                            "CUDA_VISIBLE_DEVICES"};

std::string value_in_file(const char* file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string value = line.substr(at + 1);
    const size_t begin = value.find_first_not_of(" \t\"");
    const size_t end = value.find_last_not_of(" \t\"");
    return begin == std::string::npos ? "" : value.substr(begin, end - begin + 1);
  }
  return {};
}

int64_t kilobytes_of_status(const char* key) {
  const std::string value = value_in_file("/proc/self/status", key, ':');
  return value.empty() ? 0 : std::strtoll(value.c_str(), nullptr, 10) * 1024;
}

std::string hypervisor() {
  std::ifstream type("/sys/hypervisor/type");
  if (std::string name; type >> name) return name;
  std::ifstream vendor("/sys/class/dmi/id/sys_vendor");
  std::string name;
  std::getline(vendor, name);
  const bool flagged =
      (" " + value_in_file("/proc/cpuinfo", "flags", ':') + " ").find(" hypervisor ") != std::string::npos;
  if (!flagged) return {};
  return name.empty() ? "yes (cpu flag)" : name;
}

}  // namespace

std::array<double, 3> load_average() {
  std::array<double, 3> load{};
  if (::getloadavg(load.data(), 3) != 3) load = {};
  return load;
}

MachineInfo machine_info() {
  MachineInfo out;
  out.cpu = value_in_file("/proc/cpuinfo", "model name", ':');
  utsname system{};
  ::uname(&system);
  if (out.cpu.empty()) out.cpu = system.machine;
  out.os = value_in_file("/etc/os-release", "PRETTY_NAME", '=') + ", " + system.sysname + " " + system.release;
  out.hypervisor = hypervisor();
  out.cores = std::max(1U, std::thread::hardware_concurrency());
  struct sysinfo memory {};
  if (::sysinfo(&memory) == 0) out.ram_bytes = static_cast<int64_t>(memory.totalram) * memory.mem_unit;
  out.load_before = out.load_after = load_average();
  for (const char* name : kDriverVariables)
    if (const char* value = std::getenv(name)) out.env[name] = value;
  return out;
}

GitInfo git_info() { return {kGitSha, kGitBranch, kGitDate, kGitDirty}; }

BuildInfo build_info() { return {kCompilerName, kCompilerVersion, kCompilerFlags, kBuildType}; }

BackendResultInfo backend_result_info(const BackendInfo& info) {
  BackendResultInfo out;
  out.id = info.id;
  out.api = info.api;
  out.vendor = info.vendor;
  out.renderer = info.renderer;
  out.version = info.version;
  out.driver = info.driver;
  out.llvm = info.llvm;
  out.simd_bits = info.simd_bits;
  out.threads = info.threads;
  out.software = info.software;
  for (const Capability capability : info.capabilities) out.capabilities.emplace_back(to_string(capability));
  out.workarounds = info.workarounds;
  const auto keep = [&](std::initializer_list<const char*> prefixes) {
    for (const char* name : kDriverVariables)
      for (const char* prefix : prefixes)
        if (const char* value = std::getenv(name); value != nullptr && std::string(name).starts_with(prefix))
          out.env[name] = value;
  };
  if (info.id == "gl") keep({"LP_", "GALLI", "MESA_", "LIBGL_", "EGL_"});
  if (info.id == "vulkan") keep({"LP_", "GALLIVM_", "MESA_SHADER", "VK_"});
  return out;
}

std::string utc_now() {
  const std::time_t time = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

int64_t resident_bytes() { return kilobytes_of_status("VmRSS"); }

int64_t peak_resident_bytes() { return kilobytes_of_status("VmHWM"); }

bool reset_peak_resident() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;  // proc(5): the peak resident set is set to the current one
  return file.good();
}

std::string version_line() {
  const std::string sha = kGitSha;
  return std::string("volumark ") + kVersion + " (commit " + (sha.empty() ? "unknown" : sha) +
         (kGitDirty ? ", with local changes" : "") + "), " + kCompilerName + " " + kCompilerVersion + ", " + kBuildType;
}

}  // namespace volumark

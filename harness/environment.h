// What a result depends on beyond the code: machine, drivers, build, environment variables.
#pragma once

#include <array>
#include <string>

#include "backends/types.h"
#include "reports/results.h"

namespace volumark {

MachineInfo machine_info();  // load_after is that of now
std::array<double, 3> load_average();
GitInfo git_info();  // of the sources that this program was built from
BuildInfo build_info();
BackendResultInfo backend_result_info(const BackendInfo& info);
std::string utc_now();  // 2026-01-31T12:34:56Z
// Resident set of the process: of now, and its high-water mark since reset_peak_resident() (where the system allows
// that; false: since the start). Bytes; 0 where the system does not say.
int64_t resident_bytes();
int64_t peak_resident_bytes();
bool reset_peak_resident();

// "volumark 0.1.0 (commit 0123abc, dirty), GNU 12.2.0, Release"
std::string version_line();

}  // namespace volumark

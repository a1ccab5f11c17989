// Figures of a cell by name, with the interval that is known of each: what claims and published cells are about.
//   frame_wall, frame_cpu, zone.NAME  seconds a frame: the cell's figure and the 95 % interval of it
//   prepare.wall, prepare.cpu         seconds
//   counter.NAME                      mean over the views
//   peak_bytes.device|process|voxels|target
//   error.METRIC                      as error_value() names them, worst view; of rmse, max and mae plus and minus the
//                                     reference's bound
//   instructions                      of all stages of all programs
#pragma once

#include <optional>
#include <string>

#include "reports/results.h"

namespace volumark {

struct Measured {
  double value = 0, lo = 0, hi = 0;  // without an interval all three are the same
};

// Empty: the name can be measured. Else what is wrong with it, and the known names.
std::string measure_fault(const std::string& measure);

// Nothing where the cell has no such figure (not drawn, not timed, no reference). Throws ResultsError for a name that
// measure_fault() refuses.
std::optional<Measured> measured(const Result& result, const std::string& measure);

// A cell's figure in the unit that a paper prints: frames/s, s, ms, bytes, KiB, MiB; as it is for any other unit.
double in_unit(double value, const std::string& unit);

}  // namespace volumark

// A ray profile as text for a terminal, as JSON, and as a picture that needs nothing else. Curves go by letters: A, B,
// ... in the order in which they were asked for.
#pragma once

#include <string>

#include "harness/probe.h"

namespace volumark {

// What stands over a profile.
struct ProbeHeading {
  std::string scene, backend;
  int view = 0;
  std::string command;  // that makes it again
};

std::string curve_letter(size_t index);
// One sentence each: what was probed, where the first two curves part.
std::string probe_summary(const Probe& probe, const ProbeHeading& heading);
std::string parting_text(const Probe& probe);
// One row a depth: value, extinction, and T, r, g, b of each curve.
std::string probe_table(const Probe& probe);
// Transmittance over depth, `columns` x `rows` characters within its frame.
std::string probe_plot(const Probe& probe, int columns = 72, int rows = 16);
std::string probe_json(const Probe& probe, const ProbeHeading& heading);

// Three panels over depth: transmittance, differences (logarithmic, with the threshold), extinction. Readable without
// colour; dark where the viewer is. The page has the table and the command with it.
std::string probe_svg(const Probe& probe, const ProbeHeading& heading);
std::string probe_html(const Probe& probe, const ProbeHeading& heading);

}  // namespace volumark

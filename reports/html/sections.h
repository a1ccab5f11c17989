// The parts of the page, each as HTML text. All text from the results is escaped here.
#pragma once

#include <string>

#include "reports/html/model.h"
#include "reports/html/pictures.h"

namespace volumark::html {

inline constexpr double kFlipTargets[] = {.1, .05, .02};

std::string run_line(const Model& model);       // when, where, from which commit
std::string summary_tiles(const Model& model);  // outcomes, bounds, parity, convergence, self-test
std::string time_to_error_tables(const Model& model);
std::string time_to_error_table(const Model& model, const Block& block);
std::string scene_sections(const Model& model, const PictureBook& book);
std::string convergence_table(const Model& model, const Block& block);
std::string problems_section(const Model& model);  // outcomes that are not ok
std::string cells_table(const Model& model);
std::string parity_table(const Model& model);
std::string claims_table(const Model& model);
std::string self_test_table(const Model& model);
std::string environment_section(const Model& model);

// Pieces that several parts share.
std::string software_tag(const Model& model, const std::string& backend);
std::string command_box(const std::string& command);  // with a button that copies it
std::string verdict_badge(const std::string& verdict);

}  // namespace volumark::html

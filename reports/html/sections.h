// The parts of the page, each as HTML text. All text from the results is escaped here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/html/model.h"
#include "reports/html/pictures.h"

namespace volumark::html {

std::string run_line(const Model& model);       // when, where, from which commit
std::string summary_tiles(const Model& model);  // outcomes, bounds, parity, convergence, self-test
std::string answers(const Model& model);        // the three questions in one view
std::string time_to_error_table(const Model& model, const Block& block);
std::string scene_sections(const Model& model, const PictureBook& book);
std::string convergence_part(const Model& model, const Block& block);
std::string attribution_part(const Model& model, const Block& block);
std::string pairs_part(const Model& model, const Block& block);
std::string regions_part(const Model& model, const Block& block);
std::string fronts_table(const Model& model, const Block& block);
std::string stability_section(const Model& model, const PictureBook& book);
std::string sensitivity_part(const Model& model, const PictureBook& book);
std::string effects_section(const Model& model, const PictureBook& book);
std::string problems_section(const Model& model);  // outcomes that are not ok
std::string cells_table(const Model& model);
std::string parity_table(const Model& model);
std::string claims_table(const Model& model, const PictureBook& book);
std::string self_test_table(const Model& model);
std::string environment_section(const Model& model);

// Pieces that several parts share.
// "WHAT in these results", with the command that gets it: an experiment's name, or "verify".
std::string missing_text(const std::string& what, const std::string& command);
std::string software_tag(const Model& model, const std::string& backend);
// A small picture that opens the comparison: `entry` and `picture` are indices into the book; the texts are HTML.
std::string thumb(size_t entry, int picture, const std::string& title, const std::string& line, const std::string& dim);
std::string command_box(const std::string& command);  // with a button that copies it
// Of a picture that lacks effects, or shows nothing; empty for any other.
std::string picture_badges(const Result& result);
std::string verdict_badge(const std::string& verdict);
// A table in a frame that scrolls sideways; columns: heading (HTML) and whether it holds numbers. With "sortable" among
// the classes the headings sort it.
std::string table_text(const std::string& name, const std::vector<std::pair<std::string, bool>>& columns,
                       const std::string& rows, const std::string& classes);
// Opens on a click or Enter; printed open.
std::string folded(const std::string& title, const std::string& inside, bool open = false);
// The command that runs a block again, with the sweeps that this run had.
std::string block_command(const Model& model, const Block& block);

}  // namespace volumark::html

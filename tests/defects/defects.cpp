// defects [--check FILE | --write FILE] [--defect NAME]: runs the stability suite on the cpu backend, once as it is and
// once for each planted error. Exits 1 where the suite fails without an error, or passes with one. --check also wants
// the table in FILE to speak of just these errors; --write renews it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "harness/verify/verify.h"
#include "tests/defects/defect_list.h"

namespace volumark {
namespace {

constexpr std::string_view kBegin = "<!-- planted defects: begin (made by the test program defects --write) -->\n";
constexpr std::string_view kEnd = "<!-- planted defects: end -->\n";
constexpr std::string_view kHead =
    "| planted error | method | caught by | deviation | bound |\n| --- | --- | --- | --- | --- |\n";

bool broken(const HardCaseRow& row) { return row.outcome == "fail" || row.outcome == "error"; }

// Left out: what needs several backends or the shipped scenes, what is of the reference alone, and one case that takes
// longer than all others together.
bool takes_part(const HardCase& hard_case) {
  const std::string_view id = hard_case.id;
  const bool own = hard_case.needs == CaseNeeds::Method || hard_case.needs == CaseNeeds::Host;
  return own && !id.starts_with("reference_") && id != "marschner_lobb";
}

std::vector<HardCaseRow> broken_rows(const PlantedDefect* planted) {
  planted_defect = planted != nullptr ? planted->kind : Defect::None;
  VerifyOptions options;
  options.backends = {"cpu"};
  options.require_backends = true;
  options.data = data_options_from_environment();
  for (const HardCase& hard_case : hard_case_list())
    if (takes_part(hard_case)) options.cases.push_back(hard_case.id);
  options.methods = {"texture3d_slices", "raycast", "slices2d"};  // those whose files are planted
  if (planted != nullptr && planted->method[0] != '\0') options.methods = {planted->method};
  std::vector<HardCaseRow> rows = run_hard_cases(options);
  std::erase_if(rows, [](const HardCaseRow& row) { return !broken(row); });
  planted_defect = Defect::None;
  return rows;
}

// Larger: further beyond its bound. An error (the case threw) beats every number.
double share(const HardCaseRow& row) {
  return row.outcome == "error" || std::isnan(row.deviation) ? INFINITY : share_of_bound(row);
}

// The case with the clearest answer first, then the others by their numbers.
std::string cases_of(const std::vector<HardCaseRow>& rows, const HardCaseRow& clearest) {
  std::vector<std::string> others;
  for (const HardCaseRow& row : rows)
    if (row.id != clearest.id && std::find(others.begin(), others.end(), row.id) == others.end())
      others.push_back(row.id);
  std::string out = fmt::format("{} `{}`", clearest.number, clearest.id);
  for (const std::string& id : others) out += fmt::format(", `{}`", id);
  return out;
}

std::string table_row(const PlantedDefect& planted, const std::vector<HardCaseRow>& rows) {
  const auto first = [&] {
    return fmt::format("| **{}**: {} | {} |", planted.name, planted.what,
                       planted.method[0] != '\0' ? fmt::format("`{}`", planted.method) : "all");
  };
  if (rows.empty()) return first() + " nothing | | |\n";
  const HardCaseRow& clearest =
      *std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return share(a) < share(b); });
  const std::string figures = clearest.outcome == "error" ? fmt::format(" {} | |", clearest.reason)
                              : clearest.deviation > 1e300
                                  ? fmt::format(" not finite | {:.2g} |", clearest.bound)
                                  : fmt::format(" {:.2g} | {:.2g} |", clearest.deviation, clearest.bound);
  return first() + fmt::format(" {} |", cases_of(rows, clearest)) + figures + "\n";
}

std::string text_of(const std::string& file) {
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

// The names in bold at the start of the table's rows, in their order.
std::vector<std::string> names_in(std::string_view table) {
  std::vector<std::string> names;
  for (size_t at = table.find("\n| **"); at != std::string_view::npos; at = table.find("\n| **", at + 1))
    names.emplace_back(table.substr(at + 5, table.find("**", at + 5) - at - 5));
  return names;
}

struct Document {
  std::string text;
  size_t from = 0, to = 0;  // of the table
};

Document read_document(const std::string& file) {
  Document document{text_of(file)};
  const size_t begin = document.text.find(kBegin);
  document.to = document.text.find(kEnd);
  if (begin == std::string::npos || document.to == std::string::npos)
    throw std::runtime_error(file + ": the marks of the table are missing");
  document.from = begin + kBegin.size();
  return document;
}

bool document_knows_all(const std::string& file) {
  const Document document = read_document(file);
  const std::vector<std::string> names =
      names_in(std::string_view(document.text).substr(document.from, document.to - document.from));
  const bool same =
      std::equal(names.begin(), names.end(), kPlantedDefects.begin(), kPlantedDefects.end(),
                 [](const std::string& name, const PlantedDefect& planted) { return name == planted.name; });
  if (!same) fmt::print(stderr, "{}: the table is of other errors; renew it with --write\n", file);
  return same;
}

void write_document(const std::string& file, const std::string& table) {
  Document document = read_document(file);
  document.text.replace(document.from, document.to - document.from, table);
  std::ofstream(file) << document.text;
}

// Without an error every case holds.
bool sound() {
  const std::vector<HardCaseRow> rows = broken_rows(nullptr);
  for (const HardCaseRow& row : rows)
    fmt::print("nothing planted: {} ({}, {}): deviation {:.3g} of bound {:.3g} {}\n", row.id, row.method, row.check,
               row.deviation, row.bound, row.reason);
  return rows.empty();
}

int run(const std::map<std::string, std::string>& options) {
  const auto option = [&](const char* name) {
    const auto found = options.find(name);
    return found == options.end() ? std::string() : found->second;
  };
  const std::string only = option("--defect");
  bool good = option("--check").empty() || document_knows_all(option("--check"));
  good = sound() && good;
  std::string table(kHead);
  for (const PlantedDefect& planted : kPlantedDefects) {
    if (!only.empty() && only != planted.name) continue;
    const auto start = std::chrono::steady_clock::now();
    const std::vector<HardCaseRow> rows = broken_rows(&planted);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::string row = table_row(planted, rows);
    fmt::print("{:4.1f} s {}{}", seconds.count(), rows.empty() ? "NOT CAUGHT " : "", row);
    std::fflush(stdout);
    table += row;
    good = good && !rows.empty();
  }
  if (!option("--write").empty()) write_document(option("--write"), table);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  std::map<std::string, std::string> options;
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  if (argc % 2 == 0) {
    std::fprintf(stderr, "usage: defects [--check FILE | --write FILE] [--defect NAME]\n");
    return 2;
  }
  try {
    return volumark::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "defects: %s\n", error.what());
    return 2;
  }
}

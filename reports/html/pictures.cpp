#include "reports/html/pictures.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "reports/html/hard_case_summary.h"

namespace volumark::html {
namespace {

constexpr std::string_view kPngMagic("\x89PNG\r\n\x1a\n", 8);

// A results file may come from anywhere: what it names must lie below its folder.
bool stays_below(const std::filesystem::path& path) {
  if (path.is_absolute() || path.has_root_name()) return false;
  return std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
}

class Reader {
 public:
  Reader(std::filesystem::path folder, size_t budget) : folder_(std::move(folder)), left_(budget) {}

  PictureBook book;

  // The index in the book, or -1 with the reason added to `note`.
  int take(const std::optional<ImageFile>& file, const char* what, std::string& note) {
    if (!file) return -1;
    if (file->preview.empty()) return refuse(what, "the run wrote no PNG preview of " + file->path, note);
    const auto known = known_.find(file->preview);
    if (known != known_.end()) return known->second;
    if (!stays_below(file->preview)) return refuse(what, file->preview + " is not below the results' folder", note);
    std::ifstream stream(folder_ / file->preview, std::ios::binary);
    std::stringstream bytes;
    if (stream) bytes << stream.rdbuf();
    const std::string text = bytes.str();
    if (!stream || text.empty()) return refuse(what, file->preview + " cannot be read", note);
    if (!text.starts_with(kPngMagic)) return refuse(what, file->preview + " is not a PNG file", note);
    if (text.size() > left_) {
      ++book.left_out;
      add(note, std::string(what) + ": left out to keep the report small, see " + file->preview);
      return -1;
    }
    left_ -= text.size();
    book.base64.push_back(to_base64(text));
    const int index = static_cast<int>(book.base64.size()) - 1;
    known_[file->preview] = index;
    return index;
  }

 private:
  static void add(std::string& note, const std::string& text) { note += (note.empty() ? "" : "; ") + text; }
  int refuse(const char* what, const std::string& why, std::string& note) {
    ++book.missing;
    add(note, std::string(what) + ": " + why);
    return -1;
  }

  std::filesystem::path folder_;
  size_t left_;
  std::map<std::string, int> known_;
};

double error_of(const Result& result) {
  return result.error ? result.error->worst.rmse : std::numeric_limits<double>::infinity();
}

// The finest cell of every row, then the second finest of every row, and so on.
std::vector<size_t> by_importance(const Model& model) {
  std::vector<std::vector<size_t>> rows;
  size_t longest = 0;
  for (const Block& block : model.blocks)
    for (const Row& row : block.rows) {
      rows.push_back(row.cells);
      std::stable_sort(rows.back().begin(), rows.back().end(), [&](size_t a, size_t b) {
        return error_of(model.results.results[a]) < error_of(model.results.results[b]);
      });
      longest = std::max(longest, rows.back().size());
    }
  std::vector<size_t> out;
  for (const Block& block : model.blocks)  // variants of effects are in no row, and are few
    for (const size_t cell : block.cells)
      if (!model.results.results[cell].key.variant.empty()) out.push_back(cell);
  for (size_t rank = 0; rank < longest; ++rank)
    for (const auto& row : rows)
      if (rank < row.size()) out.push_back(row[rank]);
  return out;
}

void read_hard_cases(const Results& results, Reader& reader) {
  constexpr size_t kFailuresEach = 4;  // of one case: the same defect shows in many rows
  for (const HardCaseGroup& group : group_cases(results.hard_cases)) {
    std::vector<const HardCaseRow*> shown;
    for (const HardCaseRow* row : group.rows) {
      if (!row->picture && !row->difference) continue;
      if (!shown.empty() && (row->outcome != "fail" || shown.size() >= kFailuresEach)) continue;
      if (std::any_of(shown.begin(), shown.end(), [&](const HardCaseRow* other) {
            return other->method == row->method && other->check == row->check && other->x == row->x &&
                   other->y == row->y;
          }))
        continue;  // the same on another backend
      std::string note;
      const std::pair pictures(reader.take(row->picture, "picture", note),
                               reader.take(row->difference, "difference", note));
      if (pictures.first < 0 && pictures.second < 0) continue;
      reader.book.hard_cases[static_cast<size_t>(row - results.hard_cases.data())] = pictures;
      shown.push_back(row);
    }
  }
}

}  // namespace

PictureBook read_pictures(const Model& model, const std::filesystem::path& folder, size_t budget) {
  Reader reader(folder, budget);
  read_hard_cases(model.results, reader);
  for (const size_t cell : by_importance(model)) {
    const Result& result = model.results.results[cell];
    for (size_t v = 0; v < result.views.size(); ++v) {
      const ViewResult& view = result.views[v];
      if (!view.rendered && !view.difference && !view.flip) continue;
      PictureEntry entry;
      entry.cell = cell;
      entry.view = v;
      entry.reference = reader.take(view.reference_image, "reference", entry.note);
      entry.rendered = reader.take(view.rendered, "image", entry.note);
      entry.difference = reader.take(view.difference, "signed difference", entry.note);
      entry.flip = reader.take(view.flip, "FLIP map", entry.note);
      reader.book.entries.push_back(std::move(entry));
    }
  }
  std::sort(reader.book.entries.begin(), reader.book.entries.end(), [](const PictureEntry& a, const PictureEntry& b) {
    return std::pair(a.cell, a.view) < std::pair(b.cell, b.view);
  });
  return std::move(reader.book);
}

std::string to_base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace volumark::html

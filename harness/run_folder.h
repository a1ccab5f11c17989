// The folder of one run: results.json, a journal of what came since it was last written, images, and a lock that is
// held while a process works in it. After a kill at any moment the folder can be read and gone on with; at most the
// cells that were open (those of one group) are lost.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include "reports/results.h"

namespace volumark {

// The folder cannot be used: not writable, full, or another process works in it.
class FolderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RunFolder {
 public:
  // Makes the folder where it is missing, and takes the lock. Throws FolderError.
  explicit RunFolder(std::filesystem::path folder);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;

  // What an earlier run left: results.json with the journal's entries; nothing where there is neither. Throws
  // ResultsError for a damaged results.json. A last line of the journal that was cut by a kill is left out.
  std::optional<Results> earlier() const;
  // How often each cell (its key as JSON text) was begun and not ended, by processes that died.
  const std::map<std::string, int>& died_in() const { return begun_; }

  // Each is on the disk when the call returns.
  void begin_cell(const CellKey& key);
  void drop_cell(const CellKey& key);  // interrupted on purpose: it did not die
  void end_cell(const Result& result);

  // Rewrites results.json and empties the journal; not oftener than every two seconds unless `force`.
  void save(const Results& results, bool force);

  const std::filesystem::path& path() const { return folder_; }

 private:
  void append(const std::string& line);
  std::filesystem::path folder_;
  int lock_ = -1, journal_ = -1;
  std::map<std::string, int> begun_;  // key -> times, of cells that have not ended
  std::chrono::steady_clock::time_point saved_{};
};

// As JSON text: what makes a series.
std::string key_text(const CellKey& key);

}  // namespace volumark

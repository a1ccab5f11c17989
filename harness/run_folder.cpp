#include "harness/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace volumark {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<Json> journal_lines(const fs::path& file) {
  std::vector<Json> out;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    Json json = Json::parse(line, nullptr, false);
    if (json.is_object()) out.push_back(std::move(json));  // a line that a kill cut short is none
  }
  return out;
}

std::map<std::string, int> begun_in(const std::vector<Json>& lines) {
  std::map<std::string, int> begun;
  for (const Json& line : lines) {
    if (line.contains("begin")) ++begun[line["begin"].dump()];
    if (line.contains("drop")) begun.erase(line["drop"].dump());
    if (line.contains("result")) begun.erase(line["result"]["key"].dump());
  }
  return begun;
}

void put(Results& results, Result result) {
  for (Result& old : results.results)
    if (old.key == result.key) {
      old = std::move(result);
      return;
    }
  results.results.push_back(std::move(result));
}

}  // namespace

std::string key_text(const CellKey& key) {
  Result carrier;
  carrier.key = key;
  return to_json(carrier)["key"].dump();
}

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_ / "images", error);
  if (error)
    throw FolderError(fmt::format("{}: the output folder cannot be made: {}; choose another with --out",
                                  folder_.string(), error.message()));
  const fs::path lock = folder_ / ".lock";
  lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0)
    throw FolderError(fmt::format("{}: the output folder cannot be written: {}; choose another with --out",
                                  folder_.string(), std::strerror(errno)));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    char owner[32] = "";
    const ssize_t length = ::pread(lock_, owner, sizeof owner - 1, 0);
    ::close(lock_);
    throw FolderError(
        fmt::format("{}: another run works in this folder (process {}); wait for it, or choose another with "
                    "--out",
                    folder_.string(), length > 0 ? owner : "unknown"));
  }
  const std::string owner = std::to_string(::getpid());
  if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, owner.data(), owner.size(), 0) < 0) {
    const int reason = errno;
    ::close(lock_);
    throw FolderError(
        fmt::format("{}: the output folder cannot be written: {}", folder_.string(), std::strerror(reason)));
  }
  begun_ = begun_in(journal_lines(folder_ / "journal.jsonl"));
  journal_ = ::open((folder_ / "journal.jsonl").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (journal_ < 0) {
    const int reason = errno;
    ::close(lock_);
    throw FolderError(fmt::format("{}: the journal cannot be written: {}", folder_.string(), std::strerror(reason)));
  }
}

RunFolder::~RunFolder() {
  ::close(journal_);
  ::close(lock_);  // releases it; the file stays, so that no two processes lock different files of one name
}

std::optional<Results> RunFolder::earlier() const {
  const bool there = fs::exists(folder_ / "results.json");
  if (!there) return std::nullopt;
  Results results = read_results(folder_);
  for (const Json& line : journal_lines(folder_ / "journal.jsonl"))
    if (line.contains("result")) put(results, result_from_json(line["result"]));
  return results;
}

void RunFolder::append(const std::string& line) {
  const std::string text = line + "\n";
  size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(journal_, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw FolderError(
          fmt::format("{}: the journal cannot be written: {}; results so far are kept, go on with --resume",
                      folder_.string(), std::strerror(errno)));
    done += static_cast<size_t>(n);
  }
  ::fdatasync(journal_);
}

void RunFolder::begin_cell(const CellKey& key) {
  const std::string text = key_text(key);
  append("{\"begin\":" + text + "}");
  ++begun_[text];
}

void RunFolder::drop_cell(const CellKey& key) {
  const std::string text = key_text(key);
  append("{\"drop\":" + text + "}");
  begun_.erase(text);
}

void RunFolder::end_cell(const Result& result) {
  append(Json{{"result", to_json(result)}}.dump());
  begun_.erase(key_text(result.key));
}

void RunFolder::save(const Results& results, bool force) {
  const auto time = std::chrono::steady_clock::now();
  if (!force && time - saved_ < std::chrono::seconds(2)) return;
  write_results(results, folder_ / "results.json");
  // From here the journal says nothing new but which cells were begun. A kill between the two steps leaves entries
  // twice, which `put` undoes.
  if (::ftruncate(journal_, 0) != 0)
    throw FolderError(fmt::format("{}: the journal cannot be emptied: {}", folder_.string(), std::strerror(errno)));
  for (const auto& [key, times] : begun_)
    for (int i = 0; i < times; ++i) append("{\"begin\":" + key + "}");
  saved_ = time;
}

}  // namespace volumark

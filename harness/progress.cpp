#include "harness/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace volumark {

std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

Progress::Progress(std::FILE* out, size_t cells)
    : out_(out), cells_(cells), terminal_(::isatty(::fileno(out)) == 1), started_(now()) {}

Progress::~Progress() { clear_bar(); }

void Progress::clear_bar() {
  if (terminal_) fmt::print(out_, "\r\033[K");
  std::fflush(out_);
}

void Progress::bar() {
  if (!terminal_ || done_ + skipped_ >= cells_ || done_ == 0) return;
  constexpr size_t width = 30;
  const size_t full = width * (done_ + skipped_) / cells_;
  const double left =
      since(started_).wall / static_cast<double>(done_) * static_cast<double>(cells_ - done_ - skipped_);
  fmt::print(out_, "[{}{}] {}/{}, {} left", std::string(full, '#'), std::string(width - full, '.'), done_ + skipped_,
             cells_, duration_text(left));
  std::fflush(out_);
}

void Progress::line(const std::string& text) {
  clear_bar();
  fmt::print(out_, "{}\n", text);
  bar();
}

void Progress::cell(const std::string& name, const std::string& text) {
  ++done_;
  line(fmt::format("[{:>{}}/{}] {:<52} {}", done_ + skipped_, std::to_string(cells_).size(), cells_, name, text));
}

}  // namespace volumark

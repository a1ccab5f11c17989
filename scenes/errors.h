// What goes wrong with scenes and their data. Messages say where, what was expected, what was found, what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace volumark {

// A scene file that cannot be used: syntax (file:line:column), content (file: /json/pointer), unknown scene.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A data file that is there but cannot be used: truncated, wrong checksum, unsupported field, NaN ...
class DataError : public SceneError {
 public:
  using SceneError::SceneError;
};

// A data file that is not there; how_to_get is one line that helps.
class DataMissing : public std::runtime_error {
 public:
  DataMissing(const std::string& message, std::string how) : std::runtime_error(message), how_to_get(std::move(how)) {}
  std::string how_to_get;
};

}  // namespace volumark

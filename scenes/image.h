// A picture: premultiplied linear RGBA, float, row 0 on top. Plain data, shared by every folder above.
#pragma once

#include <cstddef>
#include <vector>

namespace volumark {

struct Image {
  int width = 0, height = 0;
  std::vector<float> rgba;  // width * height * 4, tight rows

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(static_cast<size_t>(w) * static_cast<size_t>(h) * 4) {}
  float* pixel(int x, int y) { return rgba.data() + index(x, y); }
  const float* pixel(int x, int y) const { return rgba.data() + index(x, y); }

 private:
  size_t index(int x, int y) const {
    return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 4;
  }
};

}  // namespace volumark

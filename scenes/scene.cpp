#include "scenes/scene.h"

#include <algorithm>

namespace volumark {

const char* to_string(Display display) {
  switch (display) {
    case Display::Direct:
      return "direct";
    case Display::Isosurface:
      return "isosurface";
    case Display::SlicePlane:
      return "slice_plane";
    case Display::Shell:
      return "shell";
  }
  return "?";
}

double gradient_floor(const Lighting& lighting, const TransferFunction& transfer, const Volume& volume) {
  const double smallest = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
  return lighting.gradient_floor * (transfer.hi - transfer.lo) / smallest;
}

}  // namespace volumark

#include "scenes/scene.h"

#include <algorithm>

namespace volumark {

double gradient_floor(const Lighting& lighting, const TransferFunction& transfer, const Volume& volume) {
  const double smallest = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
  return lighting.gradient_floor * (transfer.hi - transfer.lo) / smallest;
}

}  // namespace volumark

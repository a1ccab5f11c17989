#include "harness/backend_parity.h"

#include <algorithm>

#include "harness/metrics/metrics.h"

namespace volumark {

namespace {

// Slice planes are opaque too, but no part of one hides another: alpha shows all their edges.
bool draws_surfaces(const Method& method) {
  const std::vector<Display>& displays = method.info().displays;
  return std::all_of(displays.begin(), displays.end(), [](Display display) { return display == Display::Isosurface; });
}

}  // namespace

bool compares_backends(const Group& group) {
  return group.experiment->parity > 0 && group.method->target_format(group.values) == Format::RGBA32F;
}

std::vector<ParityRow> backend_parity(const Group& group, const std::string& variant,
                                      const std::vector<std::map<int, Image>>& images) {
  std::vector<ParityRow> out;
  ParityLimits limits;
  limits.difference = group.experiment->parity;
  limits.hidden_edges = draws_surfaces(*group.method);
  const std::map<int, Image>* first = nullptr;
  const Cell* first_cell = nullptr;
  for (size_t i = 0; i < images.size(); ++i) {
    const Cell& cell = group.cells[i];
    if (cell.key.variant != variant || images[i].empty()) continue;
    if (first == nullptr) {
      first = &images[i];
      first_cell = &cell;
      continue;
    }
    for (const auto& [view, image] : images[i]) {
      if (!first->contains(view)) continue;
      const Parity found = parity(first->at(view), image, limits);
      ParityRow row;
      row.key = first_cell->key;
      row.other = cell.backend;
      row.view = view;
      row.interior_pixels = found.interior_pixels;
      row.interior_over = found.interior_over;
      row.interior_max = found.interior_max;
      row.silhouette_pixels = found.silhouette_pixels;
      row.silhouette_over = found.silhouette_over;
      row.silhouette_max = found.silhouette_max;
      row.limit = limits.difference;
      row.ok = found.agree;
      out.push_back(std::move(row));
    }
  }
  return out;
}

}  // namespace volumark

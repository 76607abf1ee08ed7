// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/narrow_band.hpp>

namespace cambium {

/// True if a field holds the blocks of a band, in the same order, on the same lattice.
template <class V, class T, int D>
bool same_blocks(const Field<V, D, Sparse>& field, const NarrowBand<T, D>& band) {
  if (!(field.lattice() == band.lattice()) || field.blocks() != band.blocks()) return false;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    if (!(field.block_index(b) == band.values().block_index(b))) return false;
  }
  return true;
}

/// Gives a field the blocks of a band, in the same order; all values are the background's afterwards unless it had them
/// already. Allocates only if the band has grown.
template <class V, class T, int D>
void take_blocks(Field<V, D, Sparse>& field, const NarrowBand<T, D>& band) {
  if (same_blocks(field, band)) return;
  if (field.lattice() == band.lattice()) {
    field.clear();
  } else {
    field = Field<V, D, Sparse>(band.lattice(), field.background());
  }
  for (std::size_t b = 0; b < band.blocks(); ++b) field.activate(band.values().block_index(b));
}

/// \throws SizeError unless the field holds the blocks of the band; `what` names it
template <class V, class T, int D>
void require_same_blocks(const Field<V, D, Sparse>& field, const NarrowBand<T, D>& band, const char* what) {
  if (same_blocks(field, band)) return;
  throw SizeError(detail::message(what, " has ", field.blocks(), " blocks that are not the ", band.blocks(),
                                  " blocks of the band: give it those with take_blocks(field, band)"));
}

}  // namespace cambium

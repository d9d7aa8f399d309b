#pragma once

#include "core/dequantization.h"
#include "core/layer_samples.h"

namespace nacre::layers {

/// The filter of least mean squared error for what samples show (docs/derivations.md, 3.5): how far
/// away neighbours are taken, and their weights, all 0 where nothing is to be told.
template <class Rank>
LayerFilter filter_of(const LayerSamples<Rank>& samples, const Occupancy<Rank>& occupancy,
                      const RowLoop& rows);
extern template LayerFilter filter_of(const LayerSamples<std::uint8_t>&,
                                      const Occupancy<std::uint8_t>&, const RowLoop&);
extern template LayerFilter filter_of(const LayerSamples<std::uint16_t>&,
                                      const Occupancy<std::uint16_t>&, const RowLoop&);

}  // namespace nacre::layers

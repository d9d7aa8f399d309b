#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <random>

namespace nacre {

/// Random numbers in sequence, the same on every machine: the engine is the standard's
/// `mt19937_64`, the distributions are our own (the standard library's differ between makers).
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform();

  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

 private:
  std::mt19937_64 engine_;
};

/// 64 random bits for a counter (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators": SplitMix64's output function at the state seed + counter * golden ratio). Any
/// sample's noise can so be had without its predecessors, on any thread.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter);

/// Two independent standard normal numbers for a counter, by the transform of Box and Muller
/// (1958), from 32 bits each; magnitudes up to 6.8.
glm::dvec2 normal_pair(std::uint64_t seed, std::uint64_t counter);

/// A smooth random field: random values on a cubic lattice, blended by quintic weights, twice
/// continuously differentiable, in [-1, 1].
///
/// @param seed        which field
/// @param p           position, in units of the lattice's edge (the wavelength is about 2)
double smooth_noise(std::uint64_t seed, const glm::dvec3& p);

}  // namespace nacre

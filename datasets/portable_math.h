#pragma once

namespace nacre {

/// Elementary functions that return the same bits on every machine.
///
/// The C library's own differ in the last place between versions, and between processors with and
/// without fused multiply-add; a seeded phantom must not. These use only what IEEE 754 rounds
/// correctly: + - * / and square root.

/// Natural logarithm, relative error below 1e-15.
/// @param x  positive, finite and normal
double portable_log(double x);

/// e^x, relative error below 1e-15; 0 below -700.
/// @param x  at most 700
double portable_exp(double x);

/// Cube root, relative error below 1e-15.
/// @param x  zero, or positive, finite and normal
double portable_cbrt(double x);

/// Error function 2/sqrt(pi) * integral of exp(-t^2) from 0 to x, absolute error below 1.5e-7
/// (Abramowitz and Stegun 1964, "Handbook of Mathematical Functions", 7.1.26).
double portable_erf(double x);

/// 1 - erf(x), with the same absolute error.
double portable_erfc(double x);

/// Cosine and sine of an angle given in turns.
struct CosSin {
  double cosine;
  double sine;
};

/// cos(2 pi u) and sin(2 pi u), absolute error below 1e-15.
/// @param u  turns, in [0, 1]
CosSin portable_cos_sin(double u);

}  // namespace nacre

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/command.h"

namespace nacre {

/// The error of pictures that a certificate, or the statement of coarse copies, gives: decibels
/// over all and over lit pixels, RMSE and the largest error. None if it is no such object.
std::optional<std::string> error_words(const nlohmann::ordered_json& error);

/// What a file states of the error of its coarse copies: maxima and sums, by the certificate's
/// views.
/// @param coarse  an object with `max` and `sum`, as far as they are stated
void say_copies_error(const nlohmann::ordered_json& coarse, Reporter& reporter);

/// Says what a set's certificate states, as far as it is one of `nacre build`'s: what other
/// writers may have put there is passed over.
void say_certificate(const nlohmann::ordered_json& certificate, Reporter& reporter);

}  // namespace nacre

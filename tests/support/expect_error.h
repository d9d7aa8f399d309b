#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace nacre::testing {

/// Runs `work`, which must throw Error with this code and a one-line message that holds `part`.
template <class Work>
void expect_error(ErrorCode code, const std::string& part, Work work) {
  try {
    work();
    ADD_FAILURE() << "expected nacre::Error with \"" << part << "\"";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(name(error.code()), name(code)) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message << "\n  does not hold: " << part;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace nacre::testing

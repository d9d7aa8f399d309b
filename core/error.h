#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace nacre {

/// What went wrong, coarse enough to act on. The command turns each into its exit status.
enum class ErrorCode {
  BadArgument,  ///< the caller broke a documented precondition (exit status 2)
  BadFile,      ///< unreadable, truncated or malformed input (exit status 3)
  Unsupported,  ///< well-formed input or wish that this build or machine cannot handle (4)
};

/// Short stable name, for logs and tests: "bad argument", "bad file", "unsupported".
std::string_view name(ErrorCode code) noexcept;

/// The only exception type the library throws on purpose (memory that runs out stays
/// `std::bad_alloc`).
///
/// `detail` is one line that names the subject, what was found and what was expected:
/// "head.nii: found 4 dimensions (64 x 64 x 20 x 100), expected 3".
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& detail);

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace nacre

#include "app/failures.h"

#include <fmt/core.h>

#include <exception>
#include <new>

#include "core/error.h"

namespace nacre {
namespace {

constexpr int kBadInput = 3;
constexpr int kCannotHere = 4;

int exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadArgument: return kWrongUse;
    case ErrorCode::BadFile: return kBadInput;
    case ErrorCode::Unsupported: return kCannotHere;
  }
  return kCannotHere;
}

}  // namespace

int complain(const std::string& program, const std::string& message, int status) {
  // Error flattens messages of many lines.
  fmt::print(stderr, "{}: {}\n", program, Error(ErrorCode::BadArgument, message).what());
  return status;
}

int guarded(const std::string& program, const std::function<int()>& work) {
  try {
    return work();
  } catch (const Error& error) {
    return complain(program, error.what(), exit_status(error.code()));
  } catch (const std::bad_alloc&) {
    return complain(program, "not enough memory", kCannotHere);
  } catch (const std::exception& error) {
    return complain(program, error.what(), kCannotHere);
  }
}

}  // namespace nacre

#pragma once

#include <memory>
#include <string>

#include "report/peer_renderer.h"

namespace nacre {

/// A peer that runs as a program of its own and draws what it is told, until this object goes.
///
/// The program is told through its standard input and answers through its standard output, one
/// picture at a time: `CASTER STEP VIEW` in a line; then `picture SECONDS WIDTH HEIGHT DEVICE` in a
/// line and the pixels as floats of the machine, row 0 first, or `refused WHY` in a line. It has
/// read its volume when it says `ready`.
class PeerProcess final : public PeerRenderer {
 public:
  /// @param command  as a shell reads it
  /// @throws Error   Unsupported if it does not start, or ends before it is ready (what it has to
  ///                 say about that goes to standard error)
  explicit PeerProcess(const std::string& command);
  ~PeerProcess() override;
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  PeerFrame draw(const PeerRecipe& recipe, std::size_t view) override;

 private:
  std::string line();
  void read(void* bytes, std::size_t count);
  [[noreturn]] void lost() const;

  struct Child;
  std::string command_;
  std::unique_ptr<Child> child_;
};

}  // namespace nacre

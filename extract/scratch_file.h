#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

namespace nacre {

/// A file without a name, for what need not stand in memory: gone with its owner, also one that is
/// killed.
class ScratchFile {
 public:
  /// @param folder  on whose file system it lies
  /// @return        none where no such file can be made
  static std::optional<ScratchFile> create(const std::filesystem::path& folder);

  /// Appends bytes; safe to call from any thread.
  /// @return  where they begin; none where they cannot be written (a full disk)
  std::optional<std::uint64_t> append(std::span<const std::byte> bytes);

  /// Reads what was appended; safe to call from any thread.
  /// @throws Error  Unsupported if it cannot be read back
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const noexcept { return number_; }

   private:
    int number_;
  };

  explicit ScratchFile(int descriptor)
      : descriptor_(std::make_unique<Descriptor>(descriptor)),
        size_(std::make_unique<std::atomic<std::uint64_t>>(0)) {}

  std::unique_ptr<Descriptor> descriptor_;
  std::unique_ptr<std::atomic<std::uint64_t>> size_;
};

}  // namespace nacre

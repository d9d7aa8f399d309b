#pragma once

#include <cstddef>
#include <string>

namespace nacre {

/// What times were taken on.
struct MachineFacts {
  std::string processor;         ///< "AMD EPYC 7763 64-Core Processor"
  int threads = 0;               ///< that the system offers
  std::size_t memory_bytes = 0;  ///< of the machine; 0 where the system does not tell
  std::string system;            ///< "Linux 6.1.0"
  std::string compiler;          ///< "GCC 12.2.0"
  bool checked_build = false;    ///< with assertions or sanitizers: slow
  double load = 0.0;             ///< mean number of running threads in the last minute
  std::string date;              ///< "2026-11-25 13:50 UTC"
};

/// Asks the system.
MachineFacts machine_facts();

}  // namespace nacre

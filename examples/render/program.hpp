#pragma once

#include <string>

namespace render {

/// The project's version, such as "0.1.0".
std::string program_version();

/// The version and a hash of the running program's own file, so that two builds are told apart. Where the system does
/// not say which file that is, the version alone. Cost: reads the file.
std::string program_build();

}  // namespace render

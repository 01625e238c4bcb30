#include "io/standard_streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include "io/descriptor.hpp"

namespace render {

void guard_standard_streams() {
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
        // The lowest free number is the stream's own. Opened the wrong way round, so that using it fails as before.
        static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
}

void print(const std::string& text) {
    if (const int error = write_all(STDOUT_FILENO, text)) {
        throw std::runtime_error(std::string("standard output: cannot be written (") + std::strerror(error) + ")");
    }
}

}  // namespace render

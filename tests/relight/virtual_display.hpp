#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "render/process.hpp"
#include "support/temporary_folder.hpp"

/// A display of its own without a screen, by Xvfb, for programs that open windows.
class VirtualDisplay {
public:
    VirtualDisplay() {
        int ends[2];
        if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
        server_ = std::make_unique<Process>(LIGHTCUTS_XVFB,
                                            std::vector<std::string>{"-displayfd", std::to_string(ends[1]), "-screen",
                                                                     "0", "1280x1024x24", "-nolisten", "tcp"},
                                            streams_.path(), streams_.path(),
                                            [read_end = ends[0]] { ::close(read_end); });
        ::close(ends[1]);
        // The server writes its number and a line's end once it takes clients.
        for (char c = 0; c != '\n';) {
            pollfd wanted{ends[0], POLLIN, 0};
            if (::poll(&wanted, 1, 60000) != 1 || ::read(ends[0], &c, 1) != 1) {
                ::close(ends[0]);
                throw std::runtime_error("Xvfb does not start: " + streams_.read("stderr"));
            }
            if (c != '\n') name_ += c;
        }
        ::close(ends[0]);
    }
    ~VirtualDisplay() {
        server_->send(SIGTERM);
        server_->wait();
    }

    /// For a new process, what makes its windows appear here.
    std::function<void()> in_process() const {
        return [this] {
            ::setenv("DISPLAY", name_.c_str(), 1);
            ::unsetenv("WAYLAND_DISPLAY");
        };
    }

    /// Lets xdotool do something here. throws: std::runtime_error if it fails.
    std::string act(const std::vector<std::string>& arguments) const {
        const TemporaryFolder streams;
        const auto result = Process(LIGHTCUTS_XDOTOOL, arguments, streams.path(), streams.path(), in_process()).wait();
        if (result.status != 0) throw std::runtime_error("xdotool: " + result.err);
        return result.out;
    }

private:
    TemporaryFolder streams_;
    std::string name_ = ":";
    std::unique_ptr<Process> server_;
};

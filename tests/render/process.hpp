#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

/// A program that runs in a folder of its own choice, with both streams caught in files.
class Process {
public:
    struct Result {
        int status = -1;  ///< exit status; 128 + signal if it was killed
        std::string out;
        std::string err;
    };

    Process(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            const std::filesystem::path& streams)
        : out_(streams / "stdout"), err_(streams / "stderr") {
        std::vector<char*> argv{const_cast<char*>(program.c_str())};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        child_ = ::fork();
        if (child_ < 0) throw std::runtime_error("fork failed");
        if (child_ == 0) {
            redirect(out_, STDOUT_FILENO);
            redirect(err_, STDERR_FILENO);
            if (::chdir(folder.c_str()) == 0) ::execv(program.c_str(), argv.data());
            ::_exit(127);
        }
    }
    ~Process() {
        if (child_ > 0) {
            ::kill(child_, SIGKILL);
            ::waitpid(child_, nullptr, 0);
        }
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const { ::kill(child_, signal); }

    Result wait() {
        int status = 0;
        ::waitpid(std::exchange(child_, -1), &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out_), text_of(err_)};
    }

private:
    static void redirect(const std::filesystem::path& path, int stream) {
        const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        ::dup2(file, stream);
        ::close(file);
    }
    static std::string text_of(const std::filesystem::path& path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }

    std::filesystem::path out_;
    std::filesystem::path err_;
    pid_t child_ = -1;
};

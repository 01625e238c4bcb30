#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
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

    /// `prepare`: called in the new process before the program is, for what it is to inherit.
    Process(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            const std::filesystem::path& streams, const std::function<void()>& prepare = {})
        : out_(streams / "stdout"), err_(streams / "stderr") {
        std::vector<char*> argv{const_cast<char*>(program.c_str())};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        child_ = ::fork();
        if (child_ < 0) throw std::runtime_error("fork failed");
        if (child_ == 0) {
            redirect(out_, STDOUT_FILENO);
            redirect(err_, STDERR_FILENO);
            // A shell starts what runs in the background with signals ignored, and programs inherit that.
            for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
            const bool there = ::chdir(folder.c_str()) == 0;
            if (prepare) prepare();
            if (there) ::execv(program.c_str(), argv.data());
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

    /// Waits until `holds()`; false if the program ends before, or a minute goes by.
    template <class Condition>
    bool wait_until(Condition&& holds) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (std::chrono::steady_clock::now() < end) {
            if (holds()) return true;
            siginfo_t state{};
            ::waitid(P_PID, static_cast<id_t>(child_), &state, WEXITED | WNOHANG | WNOWAIT);
            if (state.si_pid == child_) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }

    /// Waits until the program has a handler for `signal`.
    bool wait_for_handler(int signal) const {
        return wait_until([&] {
            std::ifstream status("/proc/" + std::to_string(child_) + "/status");
            for (std::string word; status >> word;) {
                if (word == "SigCgt:")
                    return status >> word && (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
            }
            return false;
        });
    }

    /// Waits until the program has computed for so many more seconds.
    bool wait_for_work(double seconds) const {
        const double end = computed() + seconds;
        return wait_until([&] { return computed() >= end; });
    }

    Result wait() {
        int status = 0;
        ::waitpid(std::exchange(child_, -1), &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out_), text_of(err_)};
    }

private:
    /// Seconds of the processor's time so far.
    double computed() const {
        const std::string state = text_of("/proc/" + std::to_string(child_) + "/stat");
        // After the name, which may hold anything: 11 others, then the ticks in the program and in the system.
        std::istringstream rest(state.substr(std::min(state.size(), state.rfind(')') + 1)));
        std::string other;
        for (int i = 0; i < 11; ++i) rest >> other;
        double own = 0, of_system = 0;
        rest >> own >> of_system;
        return (own + of_system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
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

#include "io/file_group.hpp"

#include <exception>
#include <new>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

void FileGroup::add(const std::filesystem::path& path, const std::function<std::vector<char>()>& bytes) {
    attempt(path, [&] {
        auto file = std::make_unique<OutputFile>(path);
        file->write(bytes());
        files_.push_back({path, std::move(file)});
    });
    if (files_.empty()) throw lightcuts::invalid_input(problem_);
}

void FileGroup::commit() {
    std::string written;
    for (const auto& [path, file] : files_) {
        if (!attempt(path, [&whole = file] { whole->commit(); })) {
            if (written.empty()) break;
            continue;
        }
        written += (written.empty() ? "" : ", ") + path.string();
    }
    if (problem_.empty()) return;
    throw lightcuts::invalid_input(problem_ + (written.empty() ? "" : "; written: " + written));
}

bool FileGroup::attempt(const std::filesystem::path& path, const std::function<void()>& action) {
    std::string problem;
    try {
        action();
        return true;
    } catch (const std::bad_alloc&) {
        problem = path.string() + ": not enough memory to write it";
    } catch (const std::exception& e) { problem = e.what(); }
    problem_ += (problem_.empty() ? "" : "; ") + problem;
    return false;
}

}  // namespace render

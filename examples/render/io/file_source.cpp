#include "io/file_source.hpp"

#include <system_error>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>

#include "io/text_file.hpp"

namespace render {
namespace {

std::string_view without_quotes(std::string_view name) {
    const bool quoted = name.size() >= 2 && name.front() == name.back() &&
                        (name.front() == '"' || name.front() == '\'');
    return quoted ? name.substr(1, name.size() - 2) : name;
}

/// `name` with `\ ` read as an escaped blank, and every other backslash as a separator of folders.
std::string portable(std::string_view name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] != '\\') {
            result += name[i];
        } else if (i + 1 < name.size() && name[i + 1] == ' ') {
            result += name[++i];
        } else {
            result += '/';
        }
    }
    return result;
}

/// The one of `candidates` whose last part is that of `path` but for upper and lower case; empty unless there is one.
template <class Paths>
std::optional<std::filesystem::path> only_similar(const Paths& candidates, const std::filesystem::path& path) {
    const std::string wanted = in_lower_case(path.filename().string());
    std::optional<std::filesystem::path> found;
    for (const std::filesystem::path& candidate : candidates) {
        if (in_lower_case(candidate.filename().string()) != wanted) continue;
        if (found) return std::nullopt;
        found = candidate;
    }
    return found;
}

}  // namespace

std::optional<std::filesystem::path> FileSource::find(const std::filesystem::path& folder,
                                                      std::string_view name) const {
    const std::string_view bare = without_quotes(name);
    // A system would take a name for what stands before a zero.
    if (bare.empty() || bare.find('\0') != std::string_view::npos) return std::nullopt;
    // On this system a backslash may be part of a name.
    for (const std::string& meant : {std::string(bare), portable(bare)}) {
        const std::filesystem::path path = folder / meant;
        if (has(path)) return path;
    }
    return similar(folder / portable(bare));
}

std::string DiskFiles::read(const std::filesystem::path& path) const {
    taken_.push_back(path);
    return read_file(path);
}

bool DiskFiles::has(const std::filesystem::path& path) const {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

std::optional<std::filesystem::path> DiskFiles::similar(const std::filesystem::path& path) const {
    std::error_code error;
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->is_regular_file(error)) files.push_back(path.parent_path() / entry->path().filename());
    }
    return only_similar(files, path);
}

std::string MemoryFiles::read(const std::filesystem::path& path) const {
    const auto found = files_.find(path.string());
    if (found == files_.end()) {
        throw lightcuts::invalid_input(path.string() + ": there is no such file; check the path");
    }
    return found->second;
}

bool MemoryFiles::has(const std::filesystem::path& path) const { return files_.contains(path.string()); }

std::optional<std::filesystem::path> MemoryFiles::similar(const std::filesystem::path& path) const {
    std::vector<std::filesystem::path> files;
    for (const auto& [name, content] : files_) {
        const std::filesystem::path file(name);
        if (file.parent_path() == path.parent_path()) files.push_back(file);
    }
    return only_similar(files, path);
}

}  // namespace render

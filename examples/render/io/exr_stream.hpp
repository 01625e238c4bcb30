#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <ImfIO.h>

namespace render {

/// A file in memory, as OpenEXR reads one. Remembers whether more was wanted than there is.
class ExrStream : public Imf::IStream {
public:
    /// pre: `bytes` outlives this object. `name`: of the file, for messages.
    ExrStream(std::string_view bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

    bool read(char to[], int count) override;
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = at; }

    bool ran_out() const { return ran_out_; }

private:
    std::string_view bytes_;
    std::uint64_t at_ = 0;
    bool ran_out_ = false;
};

}  // namespace render

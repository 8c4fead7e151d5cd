#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace ode::soft {

/// Reads numbers and words from the bytes of a file, text or binary, and refuses with the file's
/// name and the place. Places are byte offsets; a text file's become line numbers in the sentence.
/// Every failing read throws InputError.
class Scan {
public:
    /// Borrows `bytes`.
    Scan(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    /// From here on places are told in bytes, not in lines, and numbers may be swapped.
    void set_binary(bool swap) {
        binary_ = true;
        swap_ = swap;
    }
    bool is_binary() const noexcept { return binary_; }
    bool swaps() const noexcept { return swap_; }

    /// Starts a comment that runs to the end of the line, in word(), integer() and real(); 0: none.
    void set_comment(char mark) { comment_ = mark; }

    /// Where the next thing starts: in text behind white space and comments.
    std::size_t place() {
        if (!binary_)
            skip_space();
        return at_;
    }
    std::size_t left() const noexcept { return bytes_.size() - at_; }
    const std::string& name() const noexcept { return name_; }

    /// Next word between white space; empty at the end of the file.
    std::string_view word();
    /// The word that word() would give.
    std::string_view peek();
    /// Rest of the line without its end and, in a file with comments, without those.
    std::string_view line();
    /// Whether another word stands before the end of the line.
    bool has_word_on_line() const;
    /// @param what  names the number in the sentence: "the number of nodes".
    std::int64_t integer(const char* what);
    double real(const char* what);
    /// A count that the rest of the file must be long enough for, so that no header makes the
    /// reader allocate more than a small multiple of the file.
    /// @param least_bytes  that one thing takes at least
    std::size_t count(const char* what, std::size_t least_bytes);
    /// The same for a count already read from `where`.
    std::size_t check_count(std::int64_t value, const char* what, std::size_t least_bytes,
                            std::size_t where) const;

    /// Next sizeof(T) bytes.
    template <class T>
    T binary(const char* what) {
        T value;
        const std::string_view raw = take(sizeof(T), what);
        char bytes[sizeof(T)];
        for (std::size_t i = 0; i < sizeof(T); ++i)
            bytes[i] = raw[swap_ ? sizeof(T) - 1 - i : i];
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }
    std::string_view take(std::size_t bytes, const char* what);
    /// Behind the next `mark`, at the start of a line or not. @return false when there is none.
    bool skip_past(std::string_view mark);
    void expect(std::string_view word);

    /// One sentence "name, line 7: what". @throws InputError
    [[noreturn]] void refuse(const std::string& what) const { refuse(what, word_at_); }
    [[noreturn]] void refuse(const std::string& what, std::size_t where) const;
    std::string describe(std::size_t where) const;

private:
    void skip_space();
    std::string_view number(const char* what);

    std::string_view bytes_;
    std::string name_;
    std::size_t at_ = 0;
    std::size_t word_at_ = 0; // start of the last thing read
    char comment_ = 0;
    bool binary_ = false;
    bool swap_ = false;
};

/// A word of the file as it may stand in a sentence: at most 40 characters, all printable.
std::string quote(std::string_view word);

} // namespace ode::soft

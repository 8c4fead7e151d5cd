#include "mesh/scan.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>

namespace ode::soft {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

// std::from_chars refuses the leading + that some writers put.
std::string_view without_plus(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

} // namespace

std::string quote(std::string_view word) {
    std::string out = "'";
    for (const char c : word.substr(0, 40))
        out += c >= ' ' && c <= '~' ? c : '?';
    return out + (word.size() > 40 ? "...'" : "'");
}

std::string Scan::describe(std::size_t where) const {
    if (binary_)
        return format("%s, byte %zu", name_.c_str(), where);
    const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(where, bytes_.size()));
    return format("%s, line %td", name_.c_str(), 1 + std::count(bytes_.begin(), end, '\n'));
}

void Scan::refuse(const std::string& what, std::size_t where) const {
    throw InputError(describe(where) + ": " + what);
}

void Scan::skip_space() {
    while (at_ < bytes_.size()) {
        if (is_space(bytes_[at_]))
            ++at_;
        else if (comment_ != 0 && bytes_[at_] == comment_)
            at_ = std::min(bytes_.find('\n', at_), bytes_.size());
        else
            return;
    }
}

std::string_view Scan::word() {
    skip_space();
    word_at_ = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_]) &&
           (comment_ == 0 || bytes_[at_] != comment_))
        ++at_;
    return bytes_.substr(word_at_, at_ - word_at_);
}

std::string_view Scan::peek() {
    const std::size_t at = at_, word_at = word_at_;
    const std::string_view out = word();
    at_ = at;
    word_at_ = word_at;
    return out;
}

bool Scan::has_word_on_line() const {
    std::size_t at = at_;
    while (at < bytes_.size() && is_space(bytes_[at]) && bytes_[at] != '\n')
        ++at;
    return at < bytes_.size() && bytes_[at] != '\n' && (comment_ == 0 || bytes_[at] != comment_);
}

std::string_view Scan::line() {
    word_at_ = at_;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view out = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (comment_ != 0)
        out = out.substr(0, out.find(comment_));
    while (!out.empty() && is_space(out.back()))
        out.remove_suffix(1);
    return out;
}

// A number that touches the end of the file may have lost digits.
std::string_view Scan::number(const char* what) {
    const std::string_view out = word();
    if (out.empty())
        refuse(format("the file ends before %s: write it again", what));
    if (at_ == bytes_.size())
        refuse(format("the file ends within %s: write it again, or end its last line", what));
    return out;
}

std::int64_t Scan::integer(const char* what) {
    const std::string_view full = number(what);
    const std::string_view text = without_plus(full);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        refuse(format("%s stands for %s: give a whole number", quote(full).c_str(), what));
    return value;
}

double Scan::real(const char* what) {
    const std::string_view full = number(what);
    const std::string_view text = without_plus(full);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument)
        refuse(format("%s stands for %s: give a number", quote(full).c_str(), what));
    if (error == std::errc::result_out_of_range) {
        if (full.find("e-") == full.npos && full.find("E-") == full.npos)
            refuse(
                format("%s is too large for %s: give a finite number", quote(full).c_str(), what));
        return 0.0; // smaller than any double
    }
    return value;
}

std::size_t Scan::count(const char* what, std::size_t least_bytes) {
    const std::int64_t value = integer(what);
    return check_count(value, what, least_bytes, word_at_);
}

std::size_t Scan::check_count(std::int64_t value, const char* what, std::size_t least_bytes,
                              std::size_t where) const {
    if (value < 0)
        refuse(format("%s is %lld: give 0 or more", what, static_cast<long long>(value)), where);
    if (static_cast<std::uint64_t>(value) > left() / least_bytes)
        refuse(format("%s is %lld, but only %zu bytes follow: correct it or write the whole file",
                      what, static_cast<long long>(value), left()),
               where);
    return static_cast<std::size_t>(value);
}

std::string_view Scan::take(std::size_t bytes, const char* what) {
    word_at_ = at_;
    if (bytes > left())
        refuse(format("the file ends before %s: write it again", what));
    at_ += bytes;
    return bytes_.substr(word_at_, bytes);
}

bool Scan::skip_past(std::string_view mark) {
    const std::size_t found = bytes_.find(mark, at_);
    if (found == bytes_.npos)
        return false;
    at_ = found + mark.size();
    return true;
}

void Scan::expect(std::string_view expected) {
    const std::string_view got = word();
    if (got != expected)
        refuse(got.empty()
                   ? format("the file ends before %s: write it again", quote(expected).c_str())
                   : format("%s stands where %s is due: correct the counts before it",
                            quote(got).c_str(), quote(expected).c_str()));
}

} // namespace ode::soft

#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

namespace ode::soft {

/// A name for an object that a stranger may keep longer than the object lives: find() tells the
/// living from the dead, also when another object has taken the place in memory. Any thread.
///
/// Make it the object's last member, so that the name ends first.
template <class T>
class LiveId {
public:
    explicit LiveId(T& object) {
        const std::lock_guard guard(lock_);
        if (free_.empty()) {
            free_.reserve(slot_.size() + 1); // so that the destructor allocates nothing
            free_.push_back(static_cast<std::uint32_t>(slot_.size()));
            slot_.push_back({});
        }
        index_ = free_.back();
        free_.pop_back();
        slot_[index_].object = &object;
    }
    ~LiveId() {
        const std::lock_guard guard(lock_);
        slot_[index_].object = nullptr;
        ++slot_[index_].generation;
        free_.push_back(index_);
    }
    LiveId(const LiveId&) = delete;
    LiveId& operator=(const LiveId&) = delete;

    /// Never null, and no address: looked up, not followed.
    void* value() const noexcept {
        const std::lock_guard guard(lock_);
        return reinterpret_cast<void*>(slot_[index_].generation << kIndexBits | (index_ + 1));
    }

    /// nullptr for the name of an object that is gone, and for anything that never was a name.
    static T* find(const void* name) noexcept {
        const auto value = reinterpret_cast<std::uintptr_t>(name);
        const std::uintptr_t index = (value & ((std::uintptr_t{1} << kIndexBits) - 1)) - 1;
        const std::lock_guard guard(lock_);
        if (index >= slot_.size() || slot_[index].generation != value >> kIndexBits)
            return nullptr;
        return slot_[index].object;
    }

private:
    static constexpr int kIndexBits = 20; ///< a million of a kind at a time

    struct Slot {
        T* object = nullptr;
        std::uintptr_t generation = 1;
    };
    static inline std::mutex lock_;
    static inline std::vector<Slot> slot_;
    static inline std::vector<std::uint32_t> free_;

    std::uint32_t index_ = 0;
};

} // namespace ode::soft

#pragma once

#include "transfer/transfer_table.h"

#include <filesystem>
#include <functional>
#include <string>

namespace ode::sound {

/// Tables of how modes sound, kept between runs: one file each, beside the modes that they are of.
///
/// A file that is damaged, of another version or of another body is told and made anew. Files are
/// written under a name of their own and renamed into place, so that two processes at once are
/// safe. A directory that can't be written is told and otherwise ignored.
struct TableCache {
    std::filesystem::path directory;              ///< empty: nothing is kept
    std::function<void(const std::string&)> tell; ///< takes such sentences; may be empty

    /// @param rule  what decides the table besides the surface: the name of the rule that makes it
    ///              and all its numbers.
    TransferTable get(const ModalSurface& surface, const std::string& rule,
                      const std::function<TransferTable()>& make) const;

    /// File name of such a table.
    static std::string name(const ModalSurface& surface, const std::string& rule);
};

} // namespace ode::sound

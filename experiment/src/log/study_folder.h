// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "../stimulus_set.h"

namespace experiment {

namespace fs = std::filesystem;

/// Refuse what is no participant label: 1 to 64 letters and digits of ASCII. Throws support::InputError.
void check_label(const std::string& label);

/// Where a study has copies of the pictures shown, below its folder stimuli.
using KeptStimuli = std::map<Stimulus, std::string>;

/// A study's folder as BIDS lays it out (Brain Imaging Data Structure 1.11, behavioural data).
class StudyFolder {
public:
    /// Look, and write nothing. Throws support::InputError where the folder holds real data and the session
    /// is simulated, or the other way round, and where it holds sessions of a protocol of another name.
    StudyFolder(fs::path folder, bool simulated, std::string protocol);

    const fs::path& folder() const { return folder_; }
    /// Make the folder and what belongs to all its participants, as far as it is not there yet, and note the
    /// participant; safe beside other programs that do the same, of which `tell` says that it waits for them.
    /// Throws InputError, Failure.
    void prepare(const std::string& title, const std::string& label,
                 const std::function<void()>& tell = {}) const;
    /// Copy the stimuli's contact sheet to stimuli/contact_sheet.png where there is one and the study has
    /// none.
    void keep_contact_sheet(const fs::path& sheet) const;
    /// Copy the pictures to stimuli/<first 12 digits of the set's digest>/, as far as they are not there
    /// unchanged, and note in `kept` those that are there, also where it throws; what a program left that was
    /// killed while it copied is removed. Throws support::Failure where the disk would be left without room
    /// for answers, and std::runtime_error.
    void keep_stimuli(const StimulusSet& stimuli, KeptStimuli& kept) const;

private:
    void check_kind() const;
    void check_room(std::uintmax_t bytes) const;
    void copy_picture(const fs::path& from, const fs::path& name) const;
    void remove_half_copies() const;

    fs::path folder_;
    bool simulated_;
    std::string protocol_;
};

/// What a study holds of all its participants, kept in memory to write it anew where it is deleted.
class StudyCopy {
public:
    /// Read it. Throws support::InputError.
    explicit StudyCopy(fs::path folder);
    /// Write what is no longer there; `tell` says that it waits for another program. Throws
    /// support::Failure, InputError.
    void restore(const std::function<void()>& tell = {}) const;

private:
    fs::path folder_;
    std::map<fs::path, std::string> contents_;
};

} // namespace experiment

// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "study_folder.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

#include "events_table.h"
#include "folder_lock.h"
#include "phenotype.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;
using support::input_error;

constexpr std::size_t longest_label = 64;
constexpr const char* events_file = "task-skin2afc_events.json";
constexpr const char* readme_file = "README.md";
constexpr const char* bids_version = "1.11.0";
constexpr const char* stimuli_folder = "stimuli";                     // BIDS has a place for them
constexpr std::size_t set_digits = 12;                                // of its digest
constexpr std::uintmax_t room_for_answers = std::uintmax_t{64} << 20; // bytes

/// Whether a study folder without description holds participants' data; what a program that was killed left
/// while it began does not count.
bool holds_data(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!entry.path().filename().string().starts_with("sub-")) {
            continue;
        }
        for (const auto& file : fs::recursive_directory_iterator(entry.path(), error)) {
            if (!file.is_directory(error) && !file.path().filename().string().starts_with(".")) {
                return true;
            }
        }
    }
    return false;
}

ordered_json description(const std::string& title, const std::string& protocol, bool simulated) {
    ordered_json generator{{"Name", "skin2afc"}, {"Version", SKIN2AFC_VERSION}};
    if (simulated) {
        generator["Description"] = "Simulated participants; no person took part";
    }
    return {{"Name", title + (simulated ? " (simulated)" : "")},
            {"BIDSVersion", bids_version},
            {"DatasetType", "raw"},
            {"GeneratedBy", ordered_json::array({generator})},
            {"Protocol", protocol},
            {"Simulated", simulated}};
}

/// What a reader needs who knows nothing of the study.
std::string readme(const std::string& title, const std::string& protocol, bool simulated) {
    return fmt::format(
        R"(# {}

{}Answers in a two-alternative forced choice between pictures of rendered skin, collected by skin2afc {}
with the protocol {}, as a data set in the Brain Imaging Data Structure (BIDS {}).

- `participants.tsv`: one row a participant; `participants.json` describes its columns.
- `sub-<label>/beh/*_beh.tsv`: one row an answered trial, in the order shown. The file of the same name that ends
  in `.json` describes the columns, and says how the session ran: instructions, seed, screen, timing, whether it is complete.
- `sub-<label>/beh/*_events.tsv`: the same trials picture by picture, each with its file below `stimuli/`.
- `phenotype/questionnaire.tsv`: answers to the questions before the first session, where there were any.
- `stimuli/`: the pictures that were shown, a folder a set, and where there was one a contact sheet.

A missing value is `n/a`. Of a participant's runs the last complete one counts, or, where none is complete, the last that
holds trials.

The program writes this text once and leaves it alone. Add what it cannot know: who took part, where and when, under
whose approval, who to ask, and under what licence the data may be used.
)",
        title.empty() ? protocol : support::one_line(title),
        simulated ? "Simulated participants; no person took part.\n\n" : "", SKIN2AFC_VERSION, protocol,
        bids_version);
}

/// Whether a study has a text for its readers, under any of the names that BIDS has for it.
bool has_readme(const fs::path& folder) {
    std::error_code unknown; // what cannot be looked at is there
    const auto there = [&](const char* name) {
        return fs::symlink_status(folder / name, unknown).type() != fs::file_type::not_found;
    };
    return there("README") || there("README.md") || there("README.rst") || there("README.txt");
}

/// Where the copies of a set are, by its manifest's digest.
fs::path set_folder(const std::string& digest) { return digest.substr(0, set_digits); }

bool is_set_folder(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    std::error_code none;
    return !entry.is_symlink(none) && entry.is_directory(none) && name.size() == set_digits &&
           name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Whether a file is there and has that SHA-256.
bool is_picture(const fs::path& file, const std::string& digest) {
    std::error_code unknown;
    return fs::is_regular_file(file, unknown) && support::sha256_of_file(file) == digest;
}

void write_if_absent(const fs::path& path, const ordered_json& content) {
    if (!fs::exists(path)) {
        support::write_atomically(path, content.dump(2) + "\n");
    }
}

} // namespace

void check_label(const std::string& label) {
    const auto allowed = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    if (label.empty() || label.size() > longest_label || !std::all_of(label.begin(), label.end(), allowed)) {
        throw input_error(
            "--participant: expected 1 to {} letters and digits (without \"sub-\"), found \"{}\"",
            longest_label, support::one_line(label.substr(0, 2 * longest_label)));
    }
}

StudyFolder::StudyFolder(fs::path folder, bool simulated, std::string protocol)
    : folder_(std::move(folder)), simulated_(simulated), protocol_(std::move(protocol)) {
    check_kind();
    ParticipantTable(folder_ / "participants.tsv");
}

/// Keep simulated participants and people apart.
void StudyFolder::check_kind() const {
    const fs::path path = folder_ / "dataset_description.json";
    bool holds_simulated = false;
    if (fs::exists(path)) {
        const std::string text = support::read_text(path);
        support::check_json_depth(text, path.string());
        const auto content = nlohmann::json::parse(text, nullptr, false);
        if (!content.is_object()) {
            throw input_error("{}: expected a JSON object, found something else or a truncated file",
                              path.string());
        }
        const auto field = content.find("Simulated");
        if (field != content.end() && !field->is_boolean()) {
            throw input_error("{}: Simulated: expected true or false, found a {}", path.string(),
                              field->type_name());
        }
        holds_simulated = field != content.end() && field->get<bool>();
        const auto held = content.find("Protocol");
        if (held != content.end() && held->is_string() && held->get<std::string>() != protocol_) {
            throw input_error(
                "{}: expected a study of the protocol {}, found one of {}; give --study another folder",
                folder_.string(), protocol_, support::one_line(held->get<std::string>()));
        }
    } else if (!holds_data(folder_)) {
        return;
    }
    if (holds_simulated != simulated_) {
        throw input_error(
            "{}: expected a study of {} participants, found one of {}; give --study another folder",
            folder_.string(), simulated_ ? "simulated" : "real",
            holds_simulated ? "simulated ones" : "real ones");
    }
}

void StudyFolder::prepare(const std::string& title, const std::string& label,
                          const std::function<void()>& tell) const {
    support::make_writable_folder(folder_);
    const FolderLock lock = FolderLock::wait(folder_, tell);
    for (const fs::path& folder : {folder_, folder_ / "phenotype"}) {
        support::remove_leftovers(folder);
    }
    check_kind();
    ParticipantTable participants(folder_ / "participants.tsv");
    write_if_absent(folder_ / "dataset_description.json", description(title, protocol_, simulated_));
    write_if_absent(folder_ / "participants.json",
                    {{"participant_id", {{"Description", "One participant, named by the experimenter"}}}});
    if (const fs::path events = folder_ / events_file; !fs::exists(events)) {
        support::write_atomically(events, events_description());
    }
    if (!has_readme(folder_)) {
        support::write_atomically(folder_ / readme_file, readme(title, protocol_, simulated_));
    }
    if (participants.note("sub-" + label, {})) {
        participants.write();
    }
}

void StudyFolder::keep_contact_sheet(const fs::path& sheet) const {
    const fs::path kept = folder_ / stimuli_folder / "contact_sheet.png";
    if (fs::is_regular_file(sheet) && !fs::exists(kept)) {
        check_room(fs::file_size(sheet));
        copy_picture(sheet, kept.filename());
    }
}

/// The copy is there whole or not at all.
void StudyFolder::copy_picture(const fs::path& from, const fs::path& name) const {
    const fs::path copies = folder_ / stimuli_folder, to = copies / name;
    support::make_writable_folder(to.parent_path());
    const FolderLock shared = FolderLock::share(copies); // what is half there has not been left
    support::PendingFile pending(to);
    fs::copy_file(from, pending.path(), fs::copy_options::overwrite_existing);
    pending.commit();
}

/// Remove what is half there, unless a program is at it.
void StudyFolder::remove_half_copies() const {
    const fs::path copies = folder_ / stimuli_folder;
    std::error_code none;
    if (!fs::is_directory(copies, none)) {
        return;
    }
    try {
        if (const auto alone = FolderLock::attempt(copies)) {
            support::remove_leftovers(copies);
            for (const auto& entry : fs::directory_iterator(copies, none)) {
                if (is_set_folder(entry)) {
                    support::remove_leftovers(entry.path());
                }
            }
        }
    } catch (const std::runtime_error&) { // where nothing may be written, there is nothing to remove
    }
}

void StudyFolder::keep_stimuli(const StimulusSet& stimuli, KeptStimuli& kept) const {
    remove_half_copies();
    // Of two sets that share names, each has a folder of its own.
    const fs::path own = set_folder(stimuli.manifest_digest());
    std::uintmax_t bytes = 0;
    for (const auto& [stimulus, file] : stimuli.files()) {
        const fs::path name = own / file.filename();
        if (is_picture(folder_ / stimuli_folder / name, stimuli.digest_of(stimulus))) {
            kept[stimulus] = name.string();
        } else {
            std::error_code vanished;
            bytes += fs::file_size(file, vanished) * (vanished ? 0 : 1);
        }
    }
    if (kept.size() < stimuli.files().size()) {
        check_room(bytes);
    }
    // A picture that was changed or removed since it was checked is not the one that is shown.
    for (const auto& [stimulus, file] : stimuli.files()) {
        const fs::path name = own / file.filename();
        if (!kept.contains(stimulus) && is_picture(file, stimuli.digest_of(stimulus))) {
            copy_picture(file, name);
            kept[stimulus] = name.string();
        }
    }
}

/// Refuse to take the room that answers may need.
void StudyFolder::check_room(std::uintmax_t bytes) const {
    if (fs::space(support::existing_part(folder_)).available < bytes + room_for_answers) {
        throw support::failure("{}: has no room for a copy of the stimuli ({} MB)", folder_.string(),
                               bytes >> 20);
    }
}

StudyCopy::StudyCopy(fs::path folder) : folder_(std::move(folder)) {
    for (const char* name : {"dataset_description.json", "participants.tsv", "participants.json", events_file,
                             "phenotype/questionnaire.tsv", "phenotype/questionnaire.json"}) {
        if (fs::exists(folder_ / name)) {
            contents_[folder_ / name] = support::read_text(folder_ / name);
        }
    }
    try {
        contents_[folder_ / readme_file] = support::read_text(folder_ / readme_file);
    } catch (const support::InputError&) { // no session needs it
    }
}

void StudyCopy::restore(const std::function<void()>& tell) const {
    support::make_writable_folder(folder_);
    const FolderLock lock = FolderLock::wait(folder_, tell);
    for (const auto& [file, content] : contents_) {
        if (!fs::exists(file)) {
            support::make_writable_folder(file.parent_path());
            support::write_atomically(file, content);
        }
    }
}

} // namespace experiment

//! Files: whole or not there, and nothing else is touched.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::thread;

use sim::file::{self, AtomicFile, FileError, is_same};

#[test]
fn a_file_is_whole_or_not_there() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.csv");
    let write = |text: &str| {
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(text.as_bytes()).unwrap();
        file
    };
    drop(write("lost"));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    write("old").finish().unwrap();
    drop(write("lost"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    write("new").finish().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    let whole = write("lost").complete().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    drop(whole);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    assert!(is_same(&path, &directory.path().join("./a.csv")));
    let error = AtomicFile::create(directory.path()).err().unwrap();
    assert!(matches!(error, FileError::Directory), "{error}");
}

/// A name that a part in the making has.
const STALE: &str = ".lgvi-abcDEF012345.part";

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

#[test]
fn a_stale_part_goes_and_one_in_the_making_stays() {
    let directory = tempfile::tempdir().unwrap();
    let (path, at) = (directory.path(), |name| directory.path().join(name));
    let mut first = AtomicFile::create(&at("a")).unwrap();
    first.write_all(b"first").unwrap();
    let [part] = &names(path)[..] else {
        panic!("one part");
    };
    assert_eq!(part.len(), STALE.len());
    fs::write(at(STALE), "of a process that was killed").unwrap();
    let whole = AtomicFile::create(&at("b")).unwrap().complete().unwrap();
    assert!(!names(path).contains(&STALE.to_owned()));
    assert!(names(path).contains(part));
    file::write(at("c"), "c").unwrap();
    first.finish().unwrap();
    whole.place().unwrap();
    assert_eq!(names(path), ["a", "b", "c"]);
    assert_eq!(fs::read(at("a")).unwrap(), b"first");
}

#[test]
fn nothing_goes_that_is_not_a_part() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    for name in [
        ".lgvi-abcDEF01234.part",
        ".lgvi-abcDEF0123456.part",
        ".lgvi-abcDEF01234-.part",
        "lgvi-abcDEF012345.part",
        ".lgvi-abcDEF012345.parts",
        ".lgvi-.part",
        "other.part",
    ] {
        fs::write(at(name), "somebody's").unwrap();
    }
    fs::create_dir(at(STALE)).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("other.part", at(".lgvi-000000000000.part")).unwrap();
    let before = names(directory.path());
    file::write(at("a"), "a").unwrap();
    let after: Vec<_> = [before, vec!["a".to_owned()]].concat();
    let mut after = after;
    after.sort();
    assert_eq!(names(directory.path()), after);
}

/// Whoever sweeps meanwhile, each file is written, and no part stays.
#[test]
fn many_files_are_made_side_by_side() {
    let directory = tempfile::tempdir().unwrap();
    let write = |thread: usize| {
        for k in 0..200 {
            let path = directory.path().join(format!("{thread}-{}", k % 3));
            file::write(&path, format!("{thread} {k}")).unwrap();
            let stale = format!(".lgvi-{thread:06}{k:06}.part");
            fs::write(directory.path().join(stale), "").unwrap();
        }
    };
    thread::scope(|scope| {
        for thread in 0..8 {
            scope.spawn(move || write(thread));
        }
    });
    file::write(directory.path().join("last"), "").unwrap();
    assert_eq!(names(directory.path()).len(), 8 * 3 + 1);
    for thread in 0..8 {
        let last = fs::read_to_string(directory.path().join(format!("{thread}-1"))).unwrap();
        assert_eq!(last, format!("{thread} 199"));
    }
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    #[test]
    fn a_file_keeps_its_permissions() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a");
        fs::write(&path, "old").unwrap();
        for kept in [0o600, 0o640, 0o666, 0o755, 0o200] {
            fs::set_permissions(&path, fs::Permissions::from_mode(kept)).unwrap();
            file::write(&path, "new").unwrap();
            assert_eq!(mode(&path), kept, "{kept:o}");
        }
        let (new, plain) = (directory.path().join("b"), directory.path().join("c"));
        file::write(&new, "").unwrap();
        fs::write(&plain, "").unwrap();
        assert_eq!(mode(&new), mode(&plain));
    }

    #[test]
    fn links_are_followed_wherever_they_lead() {
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("there")).unwrap();
        symlink("there/a", at("link")).unwrap();
        symlink(at("link"), at("chain")).unwrap();
        // First it dangles, then it does not.
        for text in ["new", "newer"] {
            file::write(at("chain"), text).unwrap();
            assert_eq!(fs::read_to_string(at("there/a")).unwrap(), text);
            assert!(fs::symlink_metadata(at("chain")).unwrap().is_symlink());
            assert!(fs::symlink_metadata(at("link")).unwrap().is_symlink());
        }
        assert_eq!(names(directory.path()), ["chain", "link", "there"]);
        assert_eq!(names(&at("there")), ["a"]);

        symlink("nowhere/a", at("lost")).unwrap();
        let error = AtomicFile::create(&at("lost")).err().unwrap();
        assert!(matches!(error, FileError::Create { .. }), "{error}");
        assert!(error.to_string().contains("nowhere"), "{error}");
        symlink("round", at("round")).unwrap();
        let error = AtomicFile::create(&at("round")).err().unwrap();
        assert!(matches!(error, FileError::Path(_)), "{error}");
    }
}

//! Output files, written whole or not at all.

use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

use dalembert_fit::robot_file::write_whole;

use crate::error::Error;

static NEXT: AtomicU32 = AtomicU32::new(0);

/// A file or folder that has not got its name yet; without [`Unfinished::finish`] it goes again.
pub struct Unfinished {
    part: PathBuf,
    name: PathBuf,
}

impl Unfinished {
    /// Chooses a name in the same folder, so that what is there can be renamed.
    pub fn beside(name: &Path) -> Result<Unfinished, Error> {
        let Some(file) = name.file_name().filter(|_| !name.is_dir()) else {
            return Err(Error::new("it is a folder").at(name.display()));
        };
        let is_lost = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.is_dir();
        if let Some(folder) = name.parent().filter(is_lost) {
            return Err(Error::new("the folder does not exist").at(folder.display()));
        }
        let mut part = file.to_os_string();
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        part.push(format!(".{}.{number}.part", process::id()));
        Ok(Unfinished {
            part: name.with_file_name(part),
            name: name.to_owned(),
        })
    }

    pub fn path(&self) -> &Path {
        &self.part
    }

    /// Gives it its name.
    pub fn finish(self) -> Result<(), Error> {
        fs::rename(&self.part, &self.name).map_err(|why| Error::new(why).at(self.name.display()))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // Renamed, never written, or there is an error to report already.
        let _ = fs::remove_file(&self.part).or_else(|_| fs::remove_dir_all(&self.part));
    }
}

/// Writes a text, whole or not at all.
pub fn write(name: &Path, text: &str) -> Result<(), Error> {
    Unfinished::beside(name)?;
    write_whole(name, text).map_err(|why| Error::new(why).at(name.display()))
}

/// A folder for what is needed while a command runs; it goes with this.
pub struct Scratch {
    folder: PathBuf,
}

impl Scratch {
    pub fn within(parent: &Path) -> Result<Scratch, Error> {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let folder = parent.join(format!("dalembert-fleet.{}.{number}", process::id()));
        fs::create_dir(&folder).map_err(|why| Error::new(why).at(folder.display()))?;
        Ok(Scratch { folder })
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A file that cannot be removed is in the folder for such files.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

//! Pages of machine code: written while they are writable, then made executable and no longer writable.
#![allow(unsafe_code)] // The operating system's calls on memory are foreign functions.

use std::ptr::NonNull;

/// Machine code that can be called; never writable and executable at once.
#[derive(Debug)]
pub(crate) struct Pages {
    start: NonNull<u8>,
    length: usize,
}

// SAFETY: the pages are read-only from the moment a `Pages` exists until it is dropped.
unsafe impl Send for Pages {}
// SAFETY: as above, sharing them shares read-only memory.
unsafe impl Sync for Pages {}

impl Pages {
    /// Copies code into fresh pages; `None` where the system refuses memory or execution.
    pub(crate) fn new(code: &[u8]) -> Option<Pages> {
        if code.is_empty() {
            return None;
        }
        let flags = libc::MAP_PRIVATE | libc::MAP_ANON;
        let access = libc::PROT_READ | libc::PROT_WRITE;
        // SAFETY: an anonymous private mapping at an address of the system's choice touches no memory in use.
        let start = unsafe { libc::mmap(std::ptr::null_mut(), code.len(), access, flags, -1, 0) };
        if start == libc::MAP_FAILED {
            return None;
        }
        let pages = Pages {
            start: NonNull::new(start.cast())?,
            length: code.len(),
        };
        // SAFETY: the mapping has at least `code.len()` writable bytes and nothing else refers to it.
        unsafe { std::ptr::copy_nonoverlapping(code.as_ptr(), pages.start.as_ptr(), code.len()) };
        // SAFETY: the range is the mapping made above; the copy is complete and no reference to it is held.
        let result =
            unsafe { libc::mprotect(start, code.len(), libc::PROT_READ | libc::PROT_EXEC) };
        // Dropping the pages unmaps them if they cannot be made executable.
        (result == 0).then_some(pages)
    }

    /// Where the code starts.
    pub(crate) fn start(&self) -> NonNull<u8> {
        self.start
    }
}

impl Drop for Pages {
    fn drop(&mut self) {
        // SAFETY: the range is a mapping of our own, and calls into it borrow `self`, so none is in progress.
        let result = unsafe { libc::munmap(self.start.as_ptr().cast(), self.length) };
        debug_assert_eq!(result, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn pages_are_executable_and_not_writable() {
        let pages = Pages::new(&[0xC3; 5000]).unwrap();
        let at = pages.start().as_ptr() as usize;
        let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
        let line = maps
            .lines()
            .find(|line| {
                let (start, rest) = line.split_once('-').unwrap();
                let (end, _) = rest.split_once(' ').unwrap();
                let parse = |text| usize::from_str_radix(text, 16).unwrap();
                (parse(start)..parse(end)).contains(&at)
            })
            .unwrap();
        assert!(line.contains(" r-xp "), "{line}");
    }

    #[test]
    fn no_code_makes_no_pages() {
        assert!(Pages::new(&[]).is_none());
    }
}

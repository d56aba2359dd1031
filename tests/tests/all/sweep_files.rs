//! What a sweep leaves on the disk: archives with every column, and a journal from which one that was killed goes on with the same bits.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use crate::ensembles::{PENDULUM, SLEIGH};
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{command, ok, run, text};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The columns of an archive, as numbers with their shapes.
fn archive(path: &Path) -> BTreeMap<String, (Vec<u64>, Vec<f64>)> {
    let file = std::fs::File::open(path).expect("an archive");
    let mut archive = zip::ZipArchive::new(file).expect("a ZIP archive");
    let mut columns = BTreeMap::new();
    for index in 0..archive.len() {
        let mut stored = archive.by_index(index).expect("a member");
        let name = stored
            .name()
            .expect("a name")
            .trim_end_matches(".npy")
            .to_owned();
        let mut bytes = Vec::new();
        stored.read_to_end(&mut bytes).expect("its bytes");
        let array = npyz::NpyFile::new(&bytes[..]).expect("an array");
        let shape = array.shape().to_vec();
        let is_float = array.dtype().descr().contains("f8");
        let values = match is_float {
            true => array.into_vec::<f64>().expect("doubles"),
            false => array
                .into_vec::<i64>()
                .expect("integers")
                .iter()
                .map(|&x| x as f64)
                .collect(),
        };
        columns.insert(name, (shape, values));
    }
    columns
}

/// Beside a coordinate `x_d` the array of the velocity `x'` has another name, in every archive.
#[test]
fn no_two_quantities_share_an_array() {
    let folder = scratch("same-names");
    let path = folder.join("model.toml");
    // Free motions: x moves with 2, x_d with 3; the energy is 13/2, the coordinate `energy` rests at 7.
    let model = "coordinates = [\"x\", \"x_d\", \"energy\"]\nlagrangian = \"(x'^2 + x_d'^2 + energy'^2)/2\"\n[initial]\nx = 0\nx_d = 5\nenergy = 7\n\"x'\" = 2\n\"x_d'\" = 3\n\"energy'\" = 0\n[simulation]\nt_end = 1\noutput = 2\n";
    std::fs::write(&path, model).expect("a scratch file");
    let at_end = |name: &str, quantity: &str| {
        let columns = archive(&folder.join(name));
        let found = columns
            .get(quantity)
            .and_then(|(_, values)| values.last().copied());
        found.unwrap_or_else(|| panic!("{quantity} among {:?}", columns.keys()))
    };
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-9, "{found}, not {expected}")
    };
    ok(&["simulate", text(&path), "--out", text(&folder)]);
    near(at_end("trajectory.npz", "x_d"), 8.0);
    near(at_end("trajectory.npz", "x_d_2"), 2.0);
    near(at_end("trajectory.npz", "x_d_d"), 3.0);
    near(at_end("trajectory.npz", "energy"), 7.0);
    near(at_end("trajectory.npz", "energy_2"), 6.5);
    ok(&[
        "sweep",
        text(&path),
        "--initial",
        "x'=1,4",
        "--out",
        text(&folder),
    ]);
    near(at_end("sweep.npz", "vary_x_d_2"), 4.0);
    near(at_end("sweep.npz", "end_x_d_2"), 4.0);
    near(at_end("sweep.npz", "end_x_d"), 8.0);
}

#[test]
fn an_archive_holds_all_columns_and_the_reasons_of_failures() {
    let folder = scratch("sweep-archive");
    let model = folder.join("model.toml");
    // A root that becomes singular at x = 1, unless the motion is slow; an event that ends the run.
    let content = "name = \"falling\"\ncoordinates = [\"x\"]\nassumptions = [\"m > 0\"]\n[parameters]\nm = 1\n[lagrangian]\nT = \"1/2 m x'^2\"\nV = \"-sqrt(1 - x)\"\n[initial]\nx = 0\n\"x'\" = 2\n[simulation]\nt_end = 2\n[events.left]\nwhen = \"x + 1\"\naction = \"stop\"\n";
    std::fs::write(&model, content).expect("a scratch file");
    let out = folder.join("out");
    let rows = folder.join("rows.csv");
    std::fs::write(&rows, "m,x'\n1,0\n1,2\n-1,0\n1,-2\n4,0.5\n").expect("a scratch file");
    let arguments = [
        "sweep",
        text(&model),
        "--rows",
        text(&rows),
        "--samples",
        "3",
        "--out",
        text(&out),
        "--json",
    ];
    let said = ok(&arguments).json();
    let count = |key: &str| said[key].as_u64();
    assert_eq!(count("trajectories"), Some(5));
    assert_eq!(
        (count("ended_early"), count("not_started")),
        (Some(1), Some(1))
    );
    assert_eq!(said["events"]["left"].as_u64(), Some(1));
    let columns = archive(&out.join("sweep.npz"));
    let names: Vec<&str> = said["columns"]
        .as_array()
        .expect("names")
        .iter()
        .filter_map(|n| n.as_str())
        .collect();
    assert_eq!(names.len(), columns.len());
    let column = |name: &str| &columns[name].1;
    assert_eq!(*column("vary_x_d"), [0.0, 2.0, 0.0, -2.0, 0.5]);
    assert_eq!(*column("stop"), [0.0, 1.0, 2.0, 10.0, 0.0]);
    assert_eq!(columns["sample_x"].0, [5, 3]);
    assert_eq!(column("sample_t")[..3], [0.0, 1.0, 2.0]);
    assert_eq!(
        column("sample_x")[2].to_bits(),
        column("end_x")[0].to_bits()
    );
    assert!(
        (column("end_x")[3] + 1.0).abs() < 1e-12 && column("t_stop")[3] == column("first_left")[3]
    );
    assert!(column("sample_x")[5].is_nan() && column("end_x")[2].is_nan());
    assert_eq!(*column("count_left"), [0.0, 0.0, 0.0, 1.0, 0.0]);
    let failures = std::fs::read_to_string(out.join("failures.csv")).expect("the reasons");
    let lines: Vec<&str> = failures.lines().collect();
    assert_eq!(lines.len(), 3, "{failures}");
    assert!(
        lines[1].starts_with("1,") && lines[1].contains("singular"),
        "{failures}"
    );
    assert!(
        lines[2].starts_with("2,") && lines[2].contains("m > 0"),
        "{failures}"
    );
    // Nothing is left of the blocks, and the same command computes nothing.
    assert!(!out.join("sweep.data").exists() && !out.join("sweep.journal").exists());
    assert!(ok(&arguments).err.contains("is complete"));
    let other = run(&[
        "sweep",
        text(&model),
        "--rows",
        text(&rows),
        "--tolerance",
        "1e-7",
        "--out",
        text(&out),
    ]);
    assert_eq!(other.status, Some(2), "{}", other.both());
    assert!(
        other.err.contains("another sweep") && other.err.contains("tolerance (1e-10"),
        "{}",
        other.err
    );
    let early = folder.join("early");
    let sweep = |more: &[&str]| {
        let own = ["sweep", text(&model), "--rows", text(&rows)];
        run(&[&own[..], &["--out", text(&early)], more].concat())
    };
    let whole = |again: &str| {
        let stopped = sweep(&["--stop-on-failure"]);
        assert_eq!(stopped.status, Some(3), "{again}: {}", stopped.both());
        let word = "trajectory 1 (m = 1, x' = 2): ";
        assert!(stopped.err.contains(word), "{again}: {}", stopped.err);
        assert!(stopped.err.contains("singular"), "{again}: {}", stopped.err);
    };
    whole("at first");
    assert!(!early.join("sweep.npz").exists());
    whole("where it is stored");
    assert!(!early.join("sweep.npz").exists());
    assert_eq!(sweep(&[]).status, Some(0));
    whole("in a sweep that is complete");
}

/// A sweep of some seconds.
fn long(out: &Path, threads: &str) -> Vec<String> {
    let arguments = [
        "sweep",
        SLEIGH,
        "--vary",
        "a=0.1:0.5:40",
        "--vary",
        "W=1:4:100",
        "--t-end",
        "60",
        "--samples",
        "3",
        "--threads",
        threads,
    ];
    let mut all: Vec<String> = arguments.map(String::from).to_vec();
    all.extend(["--out".into(), text(out).into()]);
    all
}

/// The whole lines of a journal.
fn journal(out: &Path) -> Vec<u8> {
    let mut bytes = std::fs::read(out.join("sweep.journal")).unwrap_or_default();
    let whole = bytes
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |at| at + 1);
    bytes.truncate(whole);
    bytes
}

#[test]
fn a_sweep_that_is_killed_goes_on_and_ends_with_the_same_bits() {
    let folder = scratch("sweep-killed");
    let whole: PathBuf = folder.join("whole");
    let list = long(&whole, "1");
    let began = Instant::now();
    ok(&list.iter().map(String::as_str).collect::<Vec<_>>());
    let took = began.elapsed();
    let out = folder.join("killed");
    let list = long(&out, "2");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let (mut kills, mut kept) = (0, Vec::new());
    while kills < 5 {
        let mut child = command(&root(), &arguments)
            .spawn()
            .expect("the program starts");
        let lines = kept.iter().filter(|&&b| b == b'\n').count();
        // Some batches more, and then a random moment.
        let waiting = Instant::now();
        while journal(&out).iter().filter(|&&b| b == b'\n').count() <= lines {
            let is_over =
                out.join("sweep.npz").exists() || waiting.elapsed() > Duration::from_secs(60);
            if is_over || child.try_wait().expect("a process").is_some() {
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let moment = took.as_micros() as u64 / 100;
        std::thread::sleep(Duration::from_micros((random >> 33) % moment.max(1)));
        child.kill().expect("a process");
        child.wait().expect("a process");
        kills += 1;
        if out.join("sweep.npz").exists() {
            break;
        }
        // Batches are on the disk as they end, what was there before still is, and none was computed twice.
        let now = journal(&out);
        assert!(now.starts_with(&kept), "kill {kills}");
        assert!(now.len() > kept.len() || kills > 1, "kill {kills}");
        assert!(!out.join("sweep.npz").exists());
        kept = now;
    }
    assert!(kills >= 2, "{kills}");
    let last = ok(&arguments).both();
    assert!(
        last.contains("were computed before") || last.contains("is complete"),
        "{last}"
    );
    for name in ["sweep.npz", "failures.csv"] {
        let of = |folder: &Path| std::fs::read(folder.join(name)).expect("a result");
        assert!(of(&whole) == of(&out), "{name} differs");
    }
}

/// Waits until something holds.
fn wait_for(what: &str, mut holds: impl FnMut() -> bool) {
    let waiting = Instant::now();
    while !holds() {
        assert!(waiting.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// How many trajectories a journal says are written.
fn stored(out: &Path) -> u64 {
    let lines = String::from_utf8(journal(out)).expect("a journal");
    let counts = lines.lines().filter_map(|line| line.split(' ').next());
    counts.map(|n| n.parse::<u64>().expect("a number")).sum()
}

#[test]
fn a_folder_is_for_one_process_at_a_time() {
    let out = scratch("sweep-twice").join("out");
    let list = long(&out, "1");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let mut first = command(&root(), &arguments)
        .spawn()
        .expect("the program starts");
    wait_for("a batch is written", || stored(&out) > 0);
    let second = run(&arguments);
    let still_runs = first.try_wait().expect("a process").is_none();
    // A killed process holds nothing.
    first.kill().expect("a process");
    first.wait().expect("a process");
    assert!(still_runs, "the first process ended too early");
    assert_eq!(second.status, Some(2), "{}", second.both());
    for word in ["another process", text(&out), "--out"] {
        assert!(second.err.contains(word), "{word}: {}", second.err);
    }
    let third = ok(&arguments);
    assert!(third.err.contains("computed before"), "{}", third.err);
}

#[test]
fn bytes_that_change_while_a_sweep_runs_do_not_get_into_its_results() {
    let folder = scratch("sweep-damaged");
    let whole = folder.join("whole");
    let list = long(&whole, "2");
    ok(&list.iter().map(String::as_str).collect::<Vec<_>>());
    let out = folder.join("out");
    let list = long(&out, "1");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let child = command(&root(), &arguments)
        .spawn()
        .expect("the program starts");
    wait_for("a batch is written", || stored(&out) > 0);
    let before = journal(&out);
    let line = String::from_utf8(before).expect("a journal");
    let count: usize = line
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    // A bit of the first number of the first column, behind the numbers of the trajectories.
    let data = out.join("sweep.data");
    let flip = || -> std::io::Result<()> {
        use std::io::{Seek, SeekFrom, Write};
        let mut options = std::fs::OpenOptions::new();
        let mut file = options.read(true).write(true).open(&data)?;
        let mut byte = [0];
        file.seek(SeekFrom::Start(8 * count as u64))?;
        file.read_exact(&mut byte)?;
        file.seek(SeekFrom::Start(8 * count as u64))?;
        file.write_all(&[byte[0] ^ 1])
    };
    flip().expect("a file of data");
    let finished = child.wait_with_output().expect("a process");
    let said = String::from_utf8_lossy(&finished.stderr);
    assert_eq!(finished.status.code(), Some(2), "{said}");
    assert!(said.contains("damaged") && said.contains("again"), "{said}");
    assert!(!out.join("sweep.npz").exists());
    // Only what was damaged is computed again.
    let again = ok(&arguments);
    let kept = format!("{} of 4000 trajectories", 4000 - count);
    assert!(again.err.contains(&kept), "{kept}: {}", again.err);
    let bytes = |folder: &Path| std::fs::read(folder.join("sweep.npz")).expect("a result");
    assert!(bytes(&whole) == bytes(&out));
}

/// Seven short trajectories, and one that does not end as long as anyone waits: what has ended is not lost with it.
#[cfg(unix)]
#[test]
fn what_has_ended_is_kept_while_others_are_under_way() {
    let folder = scratch("sweep-slow");
    let model = folder.join("model.toml");
    let content = PENDULUM.replace(
        "tolerance = 1e-12",
        "tolerance = 1e-12\nmax_steps = 1000000000",
    );
    let (content, _) = content.split_once("[events").expect("an event");
    std::fs::write(&model, content).expect("a scratch file");
    for method in ["taylor", "dormand-prince-853"] {
        let out = folder.join(method);
        let ranges = ["--vary", "G=9,1e18,3,4,5,6,7,8", "--threads", "2"];
        let own = [
            "sweep",
            text(&model),
            "--method",
            method,
            "--out",
            text(&out),
        ];
        let arguments = [&own[..], &ranges[..]].concat();
        let start = || {
            command(&root(), &arguments)
                .spawn()
                .expect("the program starts")
        };
        let mut killed = start();
        wait_for("seven trajectories are written", || stored(&out) == 7);
        killed.kill().expect("a process");
        killed.wait().expect("a process");
        let before = journal(&out);
        let interrupted = start();
        // Long enough for the program to listen and to be at work.
        std::thread::sleep(Duration::from_secs(3));
        let sent = std::process::Command::new("kill")
            .args(["-INT", &interrupted.id().to_string()])
            .status();
        assert!(sent.expect("kill").success());
        let finished = interrupted.wait_with_output().expect("a process");
        let said = String::from_utf8_lossy(&finished.stderr);
        assert_eq!(finished.status.code(), Some(3), "{method}: {said}");
        for word in [
            "7 of 8 trajectories were computed before",
            "7 of 8 trajectories are kept",
        ] {
            assert!(said.contains(word), "{method}: {word}: {said}");
        }
        assert_eq!(journal(&out), before, "{method}: nothing is computed twice");
    }
}

#[test]
fn a_torn_journal_and_a_changed_block_are_computed_again() {
    let folder = scratch("sweep-torn");
    let list = |out: &Path| {
        let arguments = [
            "sweep",
            SLEIGH,
            "--vary",
            "a=0.1:0.5:40",
            "--t-end",
            "2",
            "--out",
        ];
        let mut all: Vec<String> = arguments.map(String::from).to_vec();
        all.push(text(out).into());
        all
    };
    let run_list = |list: &[String], more: &[&str]| {
        let arguments: Vec<&str> = list
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        run(&arguments)
    };
    let whole = folder.join("whole");
    assert_eq!(run_list(&list(&whole), &[]).status, Some(0));
    let bytes = std::fs::read(whole.join("sweep.npz")).expect("a result");
    let record = std::fs::read(whole.join("sweep.json")).expect("a record");
    for spoil in 0..3 {
        let out = folder.join(format!("torn-{spoil}"));
        std::fs::create_dir_all(&out).expect("a scratch folder");
        std::fs::write(out.join("sweep.json"), &record).expect("a scratch file");
        let (data, journal) = match spoil {
            0 => (b"no block".to_vec(), b"0 0 8 00".to_vec()),
            1 => (
                Vec::new(),
                chetaev::ensemble::Record::new(2, 0, b"lost bytes")
                    .line()
                    .into_bytes(),
            ),
            _ => (
                b"other bytes".to_vec(),
                chetaev::ensemble::Record::new(0, 0, b"those bytes")
                    .line()
                    .into_bytes(),
            ),
        };
        std::fs::write(out.join("sweep.data"), data).expect("a scratch file");
        std::fs::write(out.join("sweep.journal"), journal).expect("a scratch file");
        let finished = run_list(&list(&out), &[]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        assert!(
            !finished.err.contains("computed before"),
            "{}",
            finished.err
        );
        assert!(
            std::fs::read(out.join("sweep.npz")).expect("a result") == bytes,
            "{spoil}"
        );
    }
    // Results without a record of what they are.
    let unknown = folder.join("unknown");
    std::fs::create_dir_all(&unknown).expect("a scratch folder");
    std::fs::write(unknown.join("sweep.npz"), b"").expect("a scratch file");
    let refused = run_list(&list(&unknown), &[]);
    assert_eq!(refused.status, Some(2), "{}", refused.both());
    assert!(refused.err.contains("sweep.json"), "{}", refused.err);
}

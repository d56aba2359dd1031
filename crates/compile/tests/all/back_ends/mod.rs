//! Every case by the interpreter, by the back end that this machine chooses, and, where that has wider vectors than
//! AVX2, by native code that keeps to AVX2.
#![allow(clippy::unwrap_used)] // A failure here is a failed test.

/// The reference.
mod interpreter {
    fn make(program: chetaev_compile::Program) -> chetaev_compile::Backend {
        chetaev_compile::Backend::interpreter(program).unwrap()
    }

    mod linear_systems {
        use super::make;
        include!("linear_systems.rs");
    }

    mod programs {
        use super::make;
        include!("programs.rs");
    }
}

/// Native code, where the machine has it.
mod chosen {
    fn make(program: chetaev_compile::Program) -> chetaev_compile::Backend {
        chetaev_compile::backend(program).unwrap()
    }

    mod linear_systems {
        use super::make;
        include!("linear_systems.rs");
    }

    mod programs {
        use super::make;
        include!("programs.rs");
    }
}

/// Native code with AVX2, where the machine has it.
#[cfg(all(unix, target_arch = "x86_64"))]
mod four_at_a_time {
    fn make(program: chetaev_compile::Program) -> chetaev_compile::Backend {
        let avx2 = chetaev_compile::Vectors::Avx2;
        chetaev_compile::Backend::with_vectors(program, avx2).unwrap()
    }

    mod linear_systems {
        use super::make;
        include!("linear_systems.rs");
    }

    mod programs {
        use super::make;
        include!("programs.rs");
    }
}

#[test]
#[cfg(all(unix, target_arch = "x86_64"))]
fn native_code_is_chosen_where_the_processor_has_the_instructions() {
    use chetaev_compile::{Native, Vectors};
    let program = || {
        let g = chetaev_symbolic::Graph::new();
        let one = [g.one()];
        let lowering = chetaev_compile::Lowering::new(&g);
        lowering.output("one", &one).lower().unwrap()
    };
    let has_instructions = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    let found = [
        is_x86_feature_detected!("avx512f"),
        is_x86_feature_detected!("avx512dq"),
        is_x86_feature_detected!("avx512bw"),
        is_x86_feature_detected!("avx512vl"),
    ];
    let has_wider = has_instructions && found.iter().all(|&is_found| is_found);
    let value = std::env::var(chetaev_compile::VARIABLE).unwrap_or_default();
    let is_off = value == "interpreter";
    let chosen = chetaev_compile::backend(program()).unwrap();
    assert_eq!(chosen.is_native(), has_instructions && !is_off);
    let expected = match (has_wider, value.as_str()) {
        _ if !chosen.is_native() => None,
        (true, "avx2") | (false, _) => Some(Vectors::Avx2),
        (true, _) => Some(Vectors::Avx512),
    };
    assert_eq!(chosen.vectors(), expected);
    for (vectors, is_there) in [
        (Vectors::Avx2, has_instructions),
        (Vectors::Avx512, has_wider),
    ] {
        let native = Native::with_vectors(program(), vectors).unwrap();
        assert_eq!(
            native.map(|native| native.vectors()),
            is_there.then_some(vectors)
        );
    }
    let interpreter = chetaev_compile::Backend::interpreter(program()).unwrap();
    assert!(!interpreter.is_native());
}

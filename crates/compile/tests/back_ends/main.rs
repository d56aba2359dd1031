//! Every case twice: by the interpreter, and by the back end that this machine chooses.
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

#[test]
#[cfg(all(unix, target_arch = "x86_64"))]
fn native_code_is_chosen_where_the_processor_has_the_instructions() {
    let program = || {
        let g = chetaev_symbolic::Graph::new();
        let one = [g.one()];
        let lowering = chetaev_compile::Lowering::new(&g);
        lowering.output("one", &one).lower().unwrap()
    };
    let has_instructions = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    let is_off = std::env::var_os(chetaev_compile::VARIABLE).is_some();
    let chosen = chetaev_compile::backend(program()).unwrap();
    assert_eq!(chosen.is_native(), has_instructions && !is_off);
    let interpreter = chetaev_compile::Backend::interpreter(program()).unwrap();
    assert!(!interpreter.is_native());
}

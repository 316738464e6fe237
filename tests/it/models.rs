//! Grammar of effect models: written names are read back, and errors name the valid forms.

use std::num::{NonZeroU8, NonZeroU16};

use proptest::prelude::*;
use pushplan::scene::{
    Assumptions, Engine, JointBelief, ModelKind, ModelPart, ModelSpec, Rate, Stride,
};

fn kind() -> impl Strategy<Value = ModelKind> {
    let stride = || any::<NonZeroU8>().prop_map(Stride);
    let engine = prop_oneof![Just(Engine::Planar), Just(Engine::Spatial)];
    let path = prop_oneof![any::<String>(), "[a-z/.,|\" ]{0,12}", Just("w64.safetensors".into())];
    prop_oneof![
        (proptest::option::of(path), any::<Option<u8>>(), stride())
            .prop_map(|(weights, steps, stride)| ModelKind::Network { weights, steps, stride }),
        stride().prop_map(|stride| ModelKind::Prior { stride }),
        (engine, any::<NonZeroU16>())
            .prop_map(|(engine, rate)| ModelKind::Simulated { engine, rate: Rate(rate) }),
        Just(ModelKind::Still),
        Just(ModelKind::NETWORK),
        Just(ModelKind::PLANAR),
    ]
}

fn part() -> impl Strategy<Value = ModelPart> {
    let joints = prop_oneof![
        Just(None),
        Just(Some(JointBelief::None)),
        Just(Some(JointBelief::Guessed)),
        Just(Some(JointBelief::Fixed)),
    ];
    let assumptions = (joints, any::<Option<u16>>(), any::<Option<u16>>())
        .prop_map(|(joints, friction, start)| Assumptions { joints, friction, start });
    (kind(), assumptions, any::<Option<u16>>()).prop_map(|(kind, assumptions, up_to)| ModelPart {
        kind,
        assumptions,
        up_to,
    })
}

fn spec() -> impl Strategy<Value = ModelSpec> {
    (part(), proptest::collection::vec(part(), 0..3))
        .prop_map(|(first, others)| others.into_iter().fold(first.into(), ModelSpec::or))
}

proptest! {
    #[test]
    fn every_model_is_read_back_as_it_was_written(spec in spec()) {
        let text = spec.to_string();
        prop_assert_eq!(text.parse::<ModelSpec>().expect(&text), spec.clone());
        let json = serde_json::to_string(&spec).expect("a string");
        prop_assert_eq!(serde_json::from_str::<ModelSpec>(&json).expect("a spec"), spec);
    }

    #[test]
    fn models_read_from_any_text_are_written_readably(
        text in "(network|prior|planar|3d|still|x)([,|=\" ](steps|frame|step|joints|up-to|weights|[0-9]|none|1/60|20mm|\\.safetensors)){0,4}"
    ) {
        if let Ok(spec) = text.parse::<ModelSpec>() {
            prop_assert_eq!(spec.to_string().parse::<ModelSpec>(), Ok(spec));
        }
    }
}

#[test]
fn texts_as_they_are_meant_to_look() {
    for text in [
        "network",
        "network,weights=runs/w64/best.safetensors,steps=0",
        "network,weights=\"a,b|c\"\"d\"",
        "prior",
        "prior,frame=20mm,joints=none",
        "prior,up-to=2|planar,step=1/120",
        "planar,friction=70%",
        "planar,start=100um",
        "3d,step=1/60",
        "prior,joints=guessed",
        "still,joints=fixed",
    ] {
        let spec: ModelSpec = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(spec.to_string(), text);
    }
    let read = |text: &str| text.parse::<ModelSpec>().map(|spec| spec.to_string());
    assert_eq!(read(" prior , frame = 10mm ").as_deref(), Ok("prior"), "blanks and defaults");
    assert_eq!(read("planar,step=1/240").as_deref(), Ok("planar"));
    let weights = "network,weights=runs/best.safetensors";
    assert_eq!(read("runs/best.safetensors").as_deref(), Ok(weights), "a file alone");
}

#[test]
fn errors_state_the_expected_value() {
    for (text, expected) in [
        ("", "`` is not an effect model; use network, prior, planar, 3d"),
        ("quasi-static", "`quasi-static` is not an effect model; use network, prior, planar"),
        ("prior|", "`` is not an effect model"),
        ("planar,frame=20mm", "`planar` has no setting `frame`; it takes step=1/120, joints="),
        ("still,x.safetensors", "`still` has no setting `x.safetensors`; it takes joints="),
        ("planar,step=0.01", "`step=0.01`: expected 1/N seconds with N from 1 to 65535"),
        ("planar,step=1/0", "expected 1/N seconds"),
        ("prior,frame=15mm", "`frame=15mm`: expected a multiple of 10mm, up to 2550mm"),
        ("prior,frame=NaNmm", "expected a multiple of 10mm"),
        ("network,steps=300", "expected a number from 0 to 255"),
        ("network,weights=", "expected a file"),
        ("network,weights=\"a", "expected a file"),
        ("prior,joints=loose", "`joints=loose`: expected none, guessed or fixed"),
        ("prior,joints", "expected none, guessed or fixed"),
        ("planar,friction=0.7", "expected a percentage such as 70%"),
        ("planar,start=0.1mm", "expected micrometres such as 100um"),
        ("prior,up-to=two", "expected a number of objects"),
        ("prior,up-to=2,up-to=3", "`up-to` is given twice"),
    ] {
        let error = text.parse::<ModelSpec>().expect_err(text).to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
}

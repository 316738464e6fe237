use pushplan::asset::ToolLibrary;
use pushplan::bench::{Case, Suite, SuiteKind, crowd_cases};
use pushplan::effect::{EffectModel, Prior, Simulated};
use pushplan::scene::{Engine, Job, Rate, Record};
use pushplan::sim::Simulator;
use std::num::NonZeroU16;
use std::time::Instant;
fn main() {
    let count: usize = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(60);
    let library = ToolLibrary::embedded().unwrap();
    let engine =
        |rate| Simulated::new(Simulator::new(Engine::Planar, Rate(NonZeroU16::new(rate).unwrap())));
    let prior = Prior::default();
    let (p120, p240) = (engine(120), engine(240));
    for (n, joints) in [(1usize, 0), (3, 0), (6, 1), (9, 1), (10, 1)] {
        let cases: Vec<Case> = match (n, joints) {
            (1, _) => Suite::draw(SuiteKind::Single, &library, 21, count).cases,
            (3, _) => Suite::draw(SuiteKind::Touching, &library, 21, 2 * count)
                .cases
                .into_iter()
                .filter(|c| c.scene.objects.len() == 3)
                .take(count)
                .collect(),
            (n, _) => crowd_cases(n, 21, count),
        };
        let run = |model: &dyn EffectModel, rounds: usize| {
            let (mut total, mut ends) = (0.0, vec![]);
            for case in &cases {
                let jobs = [Job::stated(&case.scene, case.motion.clone())];
                let mut best = f64::INFINITY;
                let mut out = None;
                for _ in 0..rounds {
                    let t = Instant::now();
                    let r = model.rollout(&case.scene, &jobs, Record::Outcome).remove(0);
                    best = best.min(t.elapsed().as_secs_f64());
                    out = Some(r.outcome().poses.clone());
                }
                total += best;
                ends.push(out.unwrap());
            }
            (total / cases.len() as f64, ends)
        };
        if let Ok(only) = std::env::var("ONLY") {
            if only == "drag" {
                let feet = pushplan::scene::Feet::new(
                    &pushplan::scene::Support::Even,
                    &pushplan::geometry::Footprint::Rectangle {
                        half: pushplan::geometry::Vector::new(0.04, 0.03),
                    },
                );
                let mut s = 0.0;
                let t = Instant::now();
                for k in 0..10_000_000 {
                    let d = feet.drag(
                        pushplan::geometry::Vector::x(),
                        (pushplan::geometry::Vector::new(1e-3 * (k % 7) as f64, 2e-3), 0.01),
                        1e-4,
                        pushplan::geometry::Vector::new(1e-3, 0.0),
                    );
                    s += d.second;
                }
                println!("{s} {:.1} ns", t.elapsed().as_secs_f64() * 100.0);
                return;
            }
            if only == n.to_string() {
                for _ in 0..10 {
                    run(&prior, 10);
                }
            }
            continue;
        }
        let truth = run(&p240, 1);
        let base = run(&p120, 3);
        let own = run(&prior, 4);
        let stats = |ends: &Vec<Vec<pushplan::geometry::Pose>>| {
            let mut e = vec![];
            for (case, (a, b)) in cases.iter().zip(truth.1.iter().zip(ends)) {
                for ((o, a), b) in case.scene.objects.iter().zip(a).zip(b) {
                    if (a.position - o.pose.position).norm() > 0.01 {
                        e.push(1e3 * (a.position - b.position).norm());
                    }
                }
            }
            e.sort_by(f64::total_cmp);
            format!(
                "{:.2} / {:.2} / {:.1}",
                e.iter().sum::<f64>() / e.len() as f64,
                e[e.len() / 2],
                e[e.len() * 95 / 100]
            )
        };
        println!(
            "{n}: prior {:.0} us = {:.2} x planar/120 {:.0} us; error {} ; planar/120 {}",
            1e6 * own.0,
            own.0 / base.0,
            1e6 * base.0,
            stats(&own.1),
            stats(&base.1)
        );
    }
}

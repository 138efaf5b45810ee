use articulated_fluid::Scene;
use study::methods::*;
fn main() {
    let scene = Scene::parse(include_str!("../../../scenes/fish-chain.toml"), "f").unwrap();
    let (model, start) = (scene.model().unwrap(), scene.initial_state().unwrap());
    let kept = model.conserved(&start).unwrap();
    let args: Vec<String> = std::env::args().skip(1).collect();
    let run = |m: Method, h: f64, until: f64| {
        let mut i = m.integrator(model.clone());
        let mut s = start.clone();
        let n = (until / h).round() as u32;
        let h = until / n as f64;
        let (mut it, mut e, mut most, mut res) = (0u64, 0f64, 0u32, 0f64);
        let (mut l, mut a) = (0f64, 0f64);
        let mut at10 = None;
        let t = std::time::Instant::now();
        for k in 1..=n {
            match i.step(&mut s, h) {
                Ok(r) => { it += r.iterations as u64; most = most.max(r.iterations); res = res.max(r.residual); }
                Err(err) => { println!("{m:14} h={h}: {err}"); return None; }
            }
            if n < 20000 || k % 50 == 0 {
            let c = model.conserved(&s).unwrap();
            e = e.max((c.energy / kept.energy - 1.0).abs());
            l = l.max((c.linear - kept.linear).norm());
            a = a.max((c.angular - kept.angular).norm());
            }
            if at10.is_none() && (s.t - 10.0).abs() < 1e-9 { at10 = Some(s.clone()); }
        }
        let us = t.elapsed().as_secs_f64() * 1e6 / n as f64;
        println!("{m:14} h={h:<8} it {:.2} most {most} res {res:.1e} energy {e:.1e} lin {l:.1e} ang {a:.1e} us/step {us:.1} s/100s {:.3}", it as f64 / n as f64, us*1e-6*100.0/h);
        at10
    };
    let reference = run(Method::Gauss8, 0.05, 10.0).unwrap();
    for arg in args {
        let (name, hs) = arg.split_once('=').unwrap();
        for h in hs.split(',') {
            if let Some(s) = run(name.parse().unwrap(), h.parse().unwrap(), 100.0) {
                println!("      error of x at 10 s {:.1e} m", (s.g.1.vec3() - reference.g.1.vec3()).norm());
            }
        }
    }
}

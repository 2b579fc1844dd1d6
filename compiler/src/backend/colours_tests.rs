//! Tests of the colours that machines show inks in.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::source::Span;
use crate::targets::find;
use proptest::prelude::*;

/// The palettes with fewer colours than a scene may ask for.
fn machines() -> [(&'static str, Vec<Own>); 3] {
    [
        ("bbc:micro", micro()),
        ("bbc:agon", agon()),
        ("6502:c64", commodore()),
    ]
}

fn lightness(rgb: [u8; 3]) -> f64 {
    Seen::of(rgb).lightness
}

/// Red, green and blue of `#rrggbb`s and names.
fn inks(text: &str) -> Vec<[u8; 3]> {
    text.split_whitespace()
        .map(|c| colour(c).unwrap())
        .collect()
}

/// The names of the colours that stand for inks.
fn names(text: &str, own: &[Own]) -> Vec<String> {
    let given = assign(&inks(text), own);
    given
        .iter()
        .map(|k| own[usize::from(*k)].name.clone())
        .collect()
}

#[test]
fn oklab_is_as_published() {
    // From the table in the source.
    for (rgb, [l, a, b]) in [
        ([255, 255, 255], [1.0, 0.0, 0.0]),
        ([255, 0, 0], [0.628, 0.225, 0.126]),
        ([0, 255, 0], [0.866, -0.234, 0.179]),
        ([0, 0, 255], [0.452, -0.032, -0.312]),
    ] {
        let seen = Seen::of(rgb);
        for (is, is_to_be) in [(seen.lightness, l), (seen.a, a), (seen.b, b)] {
            assert!((is - is_to_be).abs() < 6e-4, "{rgb:?}: {seen:?}");
        }
    }
}

#[test]
fn a_machines_own_colours_stay_what_they_are() {
    for (name, own) in machines() {
        let all: Vec<[u8; 3]> = own.iter().map(|o| o.rgb).collect();
        let numbers: Vec<u8> = (0..own.len() as u8).collect();
        assert_eq!(assign(&all, &own), numbers, "{name}");
    }
    let own = "white red black cyan yellow blue green grey purple brown orange";
    assert_eq!(names(own, &commodore()).join(" "), own);
    let own = "black red yellow white";
    assert_eq!(names(own, &micro()).join(" "), own);
}

#[test]
fn greys_go_to_colours_in_order() {
    let of = |text| names(text, &micro()).join(" ");
    assert_eq!(of("black #404060 #8080a0 white"), "black blue cyan white");
    assert_eq!(of("white #8080a0 #404060 black"), "white cyan blue black");
    assert_eq!(of("black grey white"), "black cyan white");
    assert_eq!(
        of("#1b1430 #50335f #a6586b #eb9a6c #fbe3b5"),
        "black blue red yellow white"
    );
    let of = |text| names(text, &commodore()).join(", ");
    assert_eq!(
        of("black #404060 #8080a0 white"),
        "black, dark grey, light grey, white"
    );
    assert_eq!(
        of("black #336 #66a #aae white"),
        "black, blue, light blue, cyan, white"
    );
    // Nothing lies between black and blue: the order is kept before blue is.
    assert_eq!(
        names("black #111 blue white", &micro()).join(" "),
        "black blue magenta white"
    );
    // Equal inks are equal; sixteen greys have all eight colours.
    assert_eq!(
        names("grey red grey", &micro()),
        ["black", "red", "black"].map(String::from)
    );
    let greys: Vec<[u8; 3]> = (0..16).map(|k| [k * 17; 3]).collect();
    let mut given = assign(&greys, &micro());
    assert!(given.is_sorted_by(|p, q| lightness(physical(*p)) <= lightness(physical(*q))));
    given.sort_unstable();
    given.dedup();
    assert_eq!(given.len(), 8);
    assert!(assign(&[], &micro()).is_empty());
}

/// What is said of inks on a target: the warning, and the way out.
fn said(palette: Vec<[u8; 3]>, target: &str) -> Option<(String, String)> {
    let image = Image {
        width: 8,
        height: 8,
        palette,
        span: Span::new(0, 0, 5),
    };
    let warning = remark(&image, find(target).unwrap())?;
    assert!(!warning.is_error());
    Some((warning.message, warning.help.unwrap()))
}

#[test]
fn other_colours_are_remarked_on() {
    let of = |text: &str, target| said(inks(text), target);
    let greys = "black #404060 #8080a0 white";
    let (warning, help) = of(greys, "bbc:micro").unwrap();
    assert_eq!(
        warning,
        "a BBC Micro shows ink #404060 as blue and #8080a0 as cyan: it has 8 colours, and no greys"
    );
    assert_eq!(
        help,
        "choose among black, red, green, yellow, blue, magenta, cyan, white, or dither between \
         two of them, black and white say"
    );
    assert_eq!(of(greys, "6502:bbc"), Some((warning, help)));
    let (warning, _) = of("black #300 white", "bbc:micro").unwrap();
    assert!(warning.contains("#330000 as red"), "{warning}");
    for (text, target) in [
        ("black red yellow white", "bbc:micro"),
        ("black #505050 #e01010 white", "bbc:agon"),
        // Paler, but no other colours.
        ("black red blue yellow", "6502:c64"),
        ("black #444 #aaa white", "6502:c64"),
        (greys, "6502:plain"),
        (greys, "bbc:basicv"),
    ] {
        assert_eq!(of(text, target), None, "{text} on {target}");
    }
    // Two that cannot be told apart.
    let greys: Vec<[u8; 3]> = (0..9).map(|k| [k * 30; 3]).collect();
    assert!(
        said(greys, "bbc:micro")
            .unwrap()
            .0
            .contains("#1e1e1e as black")
    );
}

/// What an assignment costs, and whether it keeps the order.
fn cost(palette: &[[u8; 3]], own: &[Own], given: &[usize]) -> Option<f64> {
    let pairs = || {
        palette
            .iter()
            .zip(given)
            .map(|(rgb, k)| (lightness(*rgb), lightness(own[*k].rgb)))
    };
    let kept = pairs().all(|(p, shown)| pairs().all(|(q, other)| p >= q || shown < other));
    let off = palette
        .iter()
        .zip(given)
        .map(|(rgb, k)| Seen::of(*rgb).off(Seen::of(own[*k].rgb)));
    kept.then(|| off.sum())
}

proptest! {
    #[test]
    fn the_order_of_lightness_is_kept_and_inks_stay_apart(
        list in prop::collection::hash_set(any::<[u8; 3]>(), 2..17)
    ) {
        let list: Vec<[u8; 3]> = list.into_iter().collect();
        for (name, own) in machines() {
            let given = assign(&list, &own);
            prop_assert_eq!(given.len(), list.len());
            let light = |k: usize| lightness(own[usize::from(given[k])].rgb);
            let exact = |k: usize| own.iter().any(|o| o.rgb == list[k] || colour(&o.name) == Some(list[k]));
            for i in 0..list.len() {
                for j in 0..list.len() {
                    let darker = lightness(list[i]) < lightness(list[j]);
                    if darker && !exact(i) && !exact(j) {
                        prop_assert!(light(i) <= light(j), "{}: {:?}", name, list);
                        prop_assert!(list.len() > own.len() || given[i] != given[j], "{}", name);
                    }
                }
            }
        }
    }

    #[test]
    fn no_assignment_in_order_is_nearer(list in prop::collection::hash_set(any::<[u8; 3]>(), 2..4)) {
        let list: Vec<[u8; 3]> = list.into_iter().collect();
        let own = micro();
        prop_assume!(list.iter().all(|rgb| own.iter().all(|o| o.rgb != *rgb)));
        let given: Vec<usize> = assign(&list, &own).into_iter().map(usize::from).collect();
        let found = cost(&list, &own, &given);
        let ways = (0..8usize.pow(list.len() as u32)).filter_map(|n| {
            let way: Vec<usize> = (0..list.len()).map(|k| n >> (3 * k) & 7).collect();
            let apart = (0..way.len()).all(|i| !way[..i].contains(&way[i]));
            apart.then(|| cost(&list, &own, &way)).flatten()
        });
        let least = ways.fold(f64::INFINITY, f64::min);
        // Sums in another order.
        prop_assert!(found.is_some_and(|found| (found - least).abs() < 1e-12), "{:?} {}", found, least);
    }

    #[test]
    fn any_of_a_machines_colours_stay_what_they_are(bits in any::<u64>()) {
        for (name, own) in machines() {
            let some = |k: &usize| bits >> k & 1 == 1;
            let chosen: Vec<usize> = (0..own.len()).filter(some).collect();
            let list: Vec<[u8; 3]> = chosen.iter().map(|k| own[*k].rgb).collect();
            let given: Vec<usize> = assign(&list, &own).into_iter().map(usize::from).collect();
            prop_assert_eq!(given, chosen, "{}", name);
        }
    }
}

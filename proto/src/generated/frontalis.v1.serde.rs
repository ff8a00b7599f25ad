impl serde::Serialize for Actor {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if !self.display_name.is_empty() {
            len += 1;
        }
        if self.revision != 0 {
            len += 1;
        }
        if self.create_time.is_some() {
            len += 1;
        }
        if !self.muscles.is_empty() {
            len += 1;
        }
        if !self.markers.is_empty() {
            len += 1;
        }
        if self.n_vertices != 0 {
            len += 1;
        }
        if self.n_triangles != 0 {
            len += 1;
        }
        if self.regions_trained {
            len += 1;
        }
        if self.basis.is_some() {
            len += 1;
        }
        if !self.muscle_set.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Actor", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if !self.display_name.is_empty() {
            struct_ser.serialize_field("displayName", &self.display_name)?;
        }
        if self.revision != 0 {
            struct_ser.serialize_field("revision", &self.revision)?;
        }
        if let Some(v) = self.create_time.as_ref() {
            struct_ser.serialize_field("createTime", v)?;
        }
        if !self.muscles.is_empty() {
            struct_ser.serialize_field("muscles", &self.muscles)?;
        }
        if !self.markers.is_empty() {
            struct_ser.serialize_field("markers", &self.markers)?;
        }
        if self.n_vertices != 0 {
            struct_ser.serialize_field("nVertices", &self.n_vertices)?;
        }
        if self.n_triangles != 0 {
            struct_ser.serialize_field("nTriangles", &self.n_triangles)?;
        }
        if self.regions_trained {
            struct_ser.serialize_field("regionsTrained", &self.regions_trained)?;
        }
        if let Some(v) = self.basis.as_ref() {
            struct_ser.serialize_field("basis", v)?;
        }
        if !self.muscle_set.is_empty() {
            struct_ser.serialize_field("muscleSet", &self.muscle_set)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Actor {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "display_name",
            "displayName",
            "revision",
            "create_time",
            "createTime",
            "muscles",
            "markers",
            "n_vertices",
            "nVertices",
            "n_triangles",
            "nTriangles",
            "regions_trained",
            "regionsTrained",
            "basis",
            "muscle_set",
            "muscleSet",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            DisplayName,
            Revision,
            CreateTime,
            Muscles,
            Markers,
            NVertices,
            NTriangles,
            RegionsTrained,
            Basis,
            MuscleSet,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "displayName" | "display_name" => Ok(GeneratedField::DisplayName),
                            "revision" => Ok(GeneratedField::Revision),
                            "createTime" | "create_time" => Ok(GeneratedField::CreateTime),
                            "muscles" => Ok(GeneratedField::Muscles),
                            "markers" => Ok(GeneratedField::Markers),
                            "nVertices" | "n_vertices" => Ok(GeneratedField::NVertices),
                            "nTriangles" | "n_triangles" => Ok(GeneratedField::NTriangles),
                            "regionsTrained" | "regions_trained" => Ok(GeneratedField::RegionsTrained),
                            "basis" => Ok(GeneratedField::Basis),
                            "muscleSet" | "muscle_set" => Ok(GeneratedField::MuscleSet),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Actor;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Actor")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Actor, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut display_name__ = None;
                let mut revision__ = None;
                let mut create_time__ = None;
                let mut muscles__ = None;
                let mut markers__ = None;
                let mut n_vertices__ = None;
                let mut n_triangles__ = None;
                let mut regions_trained__ = None;
                let mut basis__ = None;
                let mut muscle_set__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::DisplayName => {
                            if display_name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("displayName"));
                            }
                            display_name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Revision => {
                            if revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("revision"));
                            }
                            revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::CreateTime => {
                            if create_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("createTime"));
                            }
                            create_time__ = map_.next_value()?;
                        }
                        GeneratedField::Muscles => {
                            if muscles__.is_some() {
                                return Err(serde::de::Error::duplicate_field("muscles"));
                            }
                            muscles__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Markers => {
                            if markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markers"));
                            }
                            markers__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NVertices => {
                            if n_vertices__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nVertices"));
                            }
                            n_vertices__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NTriangles => {
                            if n_triangles__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nTriangles"));
                            }
                            n_triangles__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RegionsTrained => {
                            if regions_trained__.is_some() {
                                return Err(serde::de::Error::duplicate_field("regionsTrained"));
                            }
                            regions_trained__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Basis => {
                            if basis__.is_some() {
                                return Err(serde::de::Error::duplicate_field("basis"));
                            }
                            basis__ = map_.next_value()?;
                        }
                        GeneratedField::MuscleSet => {
                            if muscle_set__.is_some() {
                                return Err(serde::de::Error::duplicate_field("muscleSet"));
                            }
                            muscle_set__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(Actor {
                    name: name__.unwrap_or_default(),
                    display_name: display_name__.unwrap_or_default(),
                    revision: revision__.unwrap_or_default(),
                    create_time: create_time__,
                    muscles: muscles__.unwrap_or_default(),
                    markers: markers__.unwrap_or_default(),
                    n_vertices: n_vertices__.unwrap_or_default(),
                    n_triangles: n_triangles__.unwrap_or_default(),
                    regions_trained: regions_trained__.unwrap_or_default(),
                    basis: basis__,
                    muscle_set: muscle_set__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Actor", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for AlignmentReport {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.scale != 0. {
            len += 1;
        }
        if self.rms_residual_cm != 0. {
            len += 1;
        }
        if self.iterations != 0 {
            len += 1;
        }
        if self.n_markers != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.AlignmentReport", len)?;
        if self.scale != 0. {
            struct_ser.serialize_field("scale", &self.scale)?;
        }
        if self.rms_residual_cm != 0. {
            struct_ser.serialize_field("rmsResidualCm", &self.rms_residual_cm)?;
        }
        if self.iterations != 0 {
            struct_ser.serialize_field("iterations", &self.iterations)?;
        }
        if self.n_markers != 0 {
            struct_ser.serialize_field("nMarkers", &self.n_markers)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for AlignmentReport {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "scale",
            "rms_residual_cm",
            "rmsResidualCm",
            "iterations",
            "n_markers",
            "nMarkers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Scale,
            RmsResidualCm,
            Iterations,
            NMarkers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "scale" => Ok(GeneratedField::Scale),
                            "rmsResidualCm" | "rms_residual_cm" => Ok(GeneratedField::RmsResidualCm),
                            "iterations" => Ok(GeneratedField::Iterations),
                            "nMarkers" | "n_markers" => Ok(GeneratedField::NMarkers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = AlignmentReport;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.AlignmentReport")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<AlignmentReport, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut scale__ = None;
                let mut rms_residual_cm__ = None;
                let mut iterations__ = None;
                let mut n_markers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Scale => {
                            if scale__.is_some() {
                                return Err(serde::de::Error::duplicate_field("scale"));
                            }
                            scale__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RmsResidualCm => {
                            if rms_residual_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rmsResidualCm"));
                            }
                            rms_residual_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Iterations => {
                            if iterations__.is_some() {
                                return Err(serde::de::Error::duplicate_field("iterations"));
                            }
                            iterations__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NMarkers => {
                            if n_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nMarkers"));
                            }
                            n_markers__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(AlignmentReport {
                    scale: scale__.unwrap_or_default(),
                    rms_residual_cm: rms_residual_cm__.unwrap_or_default(),
                    iterations: iterations__.unwrap_or_default(),
                    n_markers: n_markers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.AlignmentReport", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for AnalysisState {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.version != 0 {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        if self.alignment.is_some() {
            len += 1;
        }
        if self.source.is_some() {
            len += 1;
        }
        if self.recentering {
            len += 1;
        }
        if self.giving_up != 0 {
            len += 1;
        }
        if self.scale_jumps != 0 {
            len += 1;
        }
        if !self.numbers.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.AnalysisState", len)?;
        if self.version != 0 {
            struct_ser.serialize_field("version", &self.version)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        if let Some(v) = self.alignment.as_ref() {
            struct_ser.serialize_field("alignment", v)?;
        }
        if let Some(v) = self.source.as_ref() {
            struct_ser.serialize_field("source", v)?;
        }
        if self.recentering {
            struct_ser.serialize_field("recentering", &self.recentering)?;
        }
        if self.giving_up != 0 {
            let v = GapCause::try_from(self.giving_up)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.giving_up)))?;
            struct_ser.serialize_field("givingUp", &v)?;
        }
        if self.scale_jumps != 0 {
            struct_ser.serialize_field("scaleJumps", &self.scale_jumps)?;
        }
        if !self.numbers.is_empty() {
            struct_ser.serialize_field("numbers", &self.numbers)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for AnalysisState {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "version",
            "actor_revision",
            "actorRevision",
            "settings",
            "alignment",
            "source",
            "recentering",
            "giving_up",
            "givingUp",
            "scale_jumps",
            "scaleJumps",
            "numbers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Version,
            ActorRevision,
            Settings,
            Alignment,
            Source,
            Recentering,
            GivingUp,
            ScaleJumps,
            Numbers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "version" => Ok(GeneratedField::Version),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "settings" => Ok(GeneratedField::Settings),
                            "alignment" => Ok(GeneratedField::Alignment),
                            "source" => Ok(GeneratedField::Source),
                            "recentering" => Ok(GeneratedField::Recentering),
                            "givingUp" | "giving_up" => Ok(GeneratedField::GivingUp),
                            "scaleJumps" | "scale_jumps" => Ok(GeneratedField::ScaleJumps),
                            "numbers" => Ok(GeneratedField::Numbers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = AnalysisState;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.AnalysisState")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<AnalysisState, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut version__ = None;
                let mut actor_revision__ = None;
                let mut settings__ = None;
                let mut alignment__ = None;
                let mut source__ = None;
                let mut recentering__ = None;
                let mut giving_up__ = None;
                let mut scale_jumps__ = None;
                let mut numbers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Version => {
                            if version__.is_some() {
                                return Err(serde::de::Error::duplicate_field("version"));
                            }
                            version__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                        GeneratedField::Alignment => {
                            if alignment__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignment"));
                            }
                            alignment__ = map_.next_value()?;
                        }
                        GeneratedField::Source => {
                            if source__.is_some() {
                                return Err(serde::de::Error::duplicate_field("source"));
                            }
                            source__ = map_.next_value()?;
                        }
                        GeneratedField::Recentering => {
                            if recentering__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recentering"));
                            }
                            recentering__ = Some(map_.next_value()?);
                        }
                        GeneratedField::GivingUp => {
                            if giving_up__.is_some() {
                                return Err(serde::de::Error::duplicate_field("givingUp"));
                            }
                            giving_up__ = Some(map_.next_value::<GapCause>()? as i32);
                        }
                        GeneratedField::ScaleJumps => {
                            if scale_jumps__.is_some() {
                                return Err(serde::de::Error::duplicate_field("scaleJumps"));
                            }
                            scale_jumps__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Numbers => {
                            if numbers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("numbers"));
                            }
                            numbers__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(AnalysisState {
                    version: version__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    settings: settings__,
                    alignment: alignment__,
                    source: source__,
                    recentering: recentering__.unwrap_or_default(),
                    giving_up: giving_up__.unwrap_or_default(),
                    scale_jumps: scale_jumps__.unwrap_or_default(),
                    numbers: numbers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.AnalysisState", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for BasisReport {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.condition_upper != 0. {
            len += 1;
        }
        if self.condition_lower != 0. {
            len += 1;
        }
        if !self.ambiguous.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.BasisReport", len)?;
        if self.condition_upper != 0. {
            struct_ser.serialize_field("conditionUpper", &self.condition_upper)?;
        }
        if self.condition_lower != 0. {
            struct_ser.serialize_field("conditionLower", &self.condition_lower)?;
        }
        if !self.ambiguous.is_empty() {
            struct_ser.serialize_field("ambiguous", &self.ambiguous)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for BasisReport {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "condition_upper",
            "conditionUpper",
            "condition_lower",
            "conditionLower",
            "ambiguous",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            ConditionUpper,
            ConditionLower,
            Ambiguous,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "conditionUpper" | "condition_upper" => Ok(GeneratedField::ConditionUpper),
                            "conditionLower" | "condition_lower" => Ok(GeneratedField::ConditionLower),
                            "ambiguous" => Ok(GeneratedField::Ambiguous),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = BasisReport;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.BasisReport")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<BasisReport, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut condition_upper__ = None;
                let mut condition_lower__ = None;
                let mut ambiguous__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::ConditionUpper => {
                            if condition_upper__.is_some() {
                                return Err(serde::de::Error::duplicate_field("conditionUpper"));
                            }
                            condition_upper__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ConditionLower => {
                            if condition_lower__.is_some() {
                                return Err(serde::de::Error::duplicate_field("conditionLower"));
                            }
                            condition_lower__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Ambiguous => {
                            if ambiguous__.is_some() {
                                return Err(serde::de::Error::duplicate_field("ambiguous"));
                            }
                            ambiguous__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(BasisReport {
                    condition_upper: condition_upper__.unwrap_or_default(),
                    condition_lower: condition_lower__.unwrap_or_default(),
                    ambiguous: ambiguous__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.BasisReport", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CaptureKind {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "CAPTURE_KIND_UNSPECIFIED",
            Self::Markers => "CAPTURE_KIND_MARKERS",
            Self::Images => "CAPTURE_KIND_IMAGES",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for CaptureKind {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "CAPTURE_KIND_UNSPECIFIED",
            "CAPTURE_KIND_MARKERS",
            "CAPTURE_KIND_IMAGES",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = CaptureKind;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "CAPTURE_KIND_UNSPECIFIED" => Ok(CaptureKind::Unspecified),
                    "CAPTURE_KIND_MARKERS" => Ok(CaptureKind::Markers),
                    "CAPTURE_KIND_IMAGES" => Ok(CaptureKind::Images),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for ClockEcho {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.server_send_nanos != 0 {
            len += 1;
        }
        if self.client_receive_nanos != 0 {
            len += 1;
        }
        if self.client_send_nanos != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ClockEcho", len)?;
        if self.server_send_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("serverSendNanos", ToString::to_string(&self.server_send_nanos).as_str())?;
        }
        if self.client_receive_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("clientReceiveNanos", ToString::to_string(&self.client_receive_nanos).as_str())?;
        }
        if self.client_send_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("clientSendNanos", ToString::to_string(&self.client_send_nanos).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ClockEcho {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "server_send_nanos",
            "serverSendNanos",
            "client_receive_nanos",
            "clientReceiveNanos",
            "client_send_nanos",
            "clientSendNanos",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            ServerSendNanos,
            ClientReceiveNanos,
            ClientSendNanos,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "serverSendNanos" | "server_send_nanos" => Ok(GeneratedField::ServerSendNanos),
                            "clientReceiveNanos" | "client_receive_nanos" => Ok(GeneratedField::ClientReceiveNanos),
                            "clientSendNanos" | "client_send_nanos" => Ok(GeneratedField::ClientSendNanos),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ClockEcho;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ClockEcho")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ClockEcho, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut server_send_nanos__ = None;
                let mut client_receive_nanos__ = None;
                let mut client_send_nanos__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::ServerSendNanos => {
                            if server_send_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("serverSendNanos"));
                            }
                            server_send_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ClientReceiveNanos => {
                            if client_receive_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clientReceiveNanos"));
                            }
                            client_receive_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ClientSendNanos => {
                            if client_send_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clientSendNanos"));
                            }
                            client_send_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ClockEcho {
                    server_send_nanos: server_send_nanos__.unwrap_or_default(),
                    client_receive_nanos: client_receive_nanos__.unwrap_or_default(),
                    client_send_nanos: client_send_nanos__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ClockEcho", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ClockReport {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.offset_nanos != 0 {
            len += 1;
        }
        if self.round_trip_nanos != 0 {
            len += 1;
        }
        if self.uncertainty_nanos != 0 {
            len += 1;
        }
        if self.drift_ppm != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ClockReport", len)?;
        if self.offset_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("offsetNanos", ToString::to_string(&self.offset_nanos).as_str())?;
        }
        if self.round_trip_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("roundTripNanos", ToString::to_string(&self.round_trip_nanos).as_str())?;
        }
        if self.uncertainty_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("uncertaintyNanos", ToString::to_string(&self.uncertainty_nanos).as_str())?;
        }
        if self.drift_ppm != 0. {
            struct_ser.serialize_field("driftPpm", &self.drift_ppm)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ClockReport {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "offset_nanos",
            "offsetNanos",
            "round_trip_nanos",
            "roundTripNanos",
            "uncertainty_nanos",
            "uncertaintyNanos",
            "drift_ppm",
            "driftPpm",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            OffsetNanos,
            RoundTripNanos,
            UncertaintyNanos,
            DriftPpm,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "offsetNanos" | "offset_nanos" => Ok(GeneratedField::OffsetNanos),
                            "roundTripNanos" | "round_trip_nanos" => Ok(GeneratedField::RoundTripNanos),
                            "uncertaintyNanos" | "uncertainty_nanos" => Ok(GeneratedField::UncertaintyNanos),
                            "driftPpm" | "drift_ppm" => Ok(GeneratedField::DriftPpm),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ClockReport;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ClockReport")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ClockReport, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut offset_nanos__ = None;
                let mut round_trip_nanos__ = None;
                let mut uncertainty_nanos__ = None;
                let mut drift_ppm__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::OffsetNanos => {
                            if offset_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("offsetNanos"));
                            }
                            offset_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RoundTripNanos => {
                            if round_trip_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("roundTripNanos"));
                            }
                            round_trip_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::UncertaintyNanos => {
                            if uncertainty_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("uncertaintyNanos"));
                            }
                            uncertainty_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::DriftPpm => {
                            if drift_ppm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("driftPpm"));
                            }
                            drift_ppm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ClockReport {
                    offset_nanos: offset_nanos__.unwrap_or_default(),
                    round_trip_nanos: round_trip_nanos__.unwrap_or_default(),
                    uncertainty_nanos: uncertainty_nanos__.unwrap_or_default(),
                    drift_ppm: drift_ppm__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ClockReport", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CoarticulationState {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.region != 0 {
            len += 1;
        }
        if !self.gesture.is_empty() {
            len += 1;
        }
        if self.intensity != 0. {
            len += 1;
        }
        if self.distance != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CoarticulationState", len)?;
        if self.region != 0 {
            struct_ser.serialize_field("region", &self.region)?;
        }
        if !self.gesture.is_empty() {
            struct_ser.serialize_field("gesture", &self.gesture)?;
        }
        if self.intensity != 0. {
            struct_ser.serialize_field("intensity", &self.intensity)?;
        }
        if self.distance != 0. {
            struct_ser.serialize_field("distance", &self.distance)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CoarticulationState {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "region",
            "gesture",
            "intensity",
            "distance",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Region,
            Gesture,
            Intensity,
            Distance,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "region" => Ok(GeneratedField::Region),
                            "gesture" => Ok(GeneratedField::Gesture),
                            "intensity" => Ok(GeneratedField::Intensity),
                            "distance" => Ok(GeneratedField::Distance),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CoarticulationState;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CoarticulationState")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CoarticulationState, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut region__ = None;
                let mut gesture__ = None;
                let mut intensity__ = None;
                let mut distance__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Region => {
                            if region__.is_some() {
                                return Err(serde::de::Error::duplicate_field("region"));
                            }
                            region__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Gesture => {
                            if gesture__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gesture"));
                            }
                            gesture__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Intensity => {
                            if intensity__.is_some() {
                                return Err(serde::de::Error::duplicate_field("intensity"));
                            }
                            intensity__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Distance => {
                            if distance__.is_some() {
                                return Err(serde::de::Error::duplicate_field("distance"));
                            }
                            distance__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(CoarticulationState {
                    region: region__.unwrap_or_default(),
                    gesture: gesture__.unwrap_or_default(),
                    intensity: intensity__.unwrap_or_default(),
                    distance: distance__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CoarticulationState", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Control {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.region != 0 {
            len += 1;
        }
        if self.driven {
            len += 1;
        }
        if self.lower != 0. {
            len += 1;
        }
        if self.upper != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Control", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.region != 0 {
            let v = FaceRegion::try_from(self.region)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.region)))?;
            struct_ser.serialize_field("region", &v)?;
        }
        if self.driven {
            struct_ser.serialize_field("driven", &self.driven)?;
        }
        if self.lower != 0. {
            struct_ser.serialize_field("lower", &self.lower)?;
        }
        if self.upper != 0. {
            struct_ser.serialize_field("upper", &self.upper)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Control {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "region",
            "driven",
            "lower",
            "upper",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Region,
            Driven,
            Lower,
            Upper,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "region" => Ok(GeneratedField::Region),
                            "driven" => Ok(GeneratedField::Driven),
                            "lower" => Ok(GeneratedField::Lower),
                            "upper" => Ok(GeneratedField::Upper),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Control;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Control")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Control, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut region__ = None;
                let mut driven__ = None;
                let mut lower__ = None;
                let mut upper__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Region => {
                            if region__.is_some() {
                                return Err(serde::de::Error::duplicate_field("region"));
                            }
                            region__ = Some(map_.next_value::<FaceRegion>()? as i32);
                        }
                        GeneratedField::Driven => {
                            if driven__.is_some() {
                                return Err(serde::de::Error::duplicate_field("driven"));
                            }
                            driven__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Lower => {
                            if lower__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lower"));
                            }
                            lower__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Upper => {
                            if upper__.is_some() {
                                return Err(serde::de::Error::duplicate_field("upper"));
                            }
                            upper__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(Control {
                    name: name__.unwrap_or_default(),
                    region: region__.unwrap_or_default(),
                    driven: driven__.unwrap_or_default(),
                    lower: lower__.unwrap_or_default(),
                    upper: upper__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Control", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ControlBounds {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.control.is_empty() {
            len += 1;
        }
        if self.lower != 0. {
            len += 1;
        }
        if self.upper != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ControlBounds", len)?;
        if !self.control.is_empty() {
            struct_ser.serialize_field("control", &self.control)?;
        }
        if self.lower != 0. {
            struct_ser.serialize_field("lower", &self.lower)?;
        }
        if self.upper != 0. {
            struct_ser.serialize_field("upper", &self.upper)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ControlBounds {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "control",
            "lower",
            "upper",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Control,
            Lower,
            Upper,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "control" => Ok(GeneratedField::Control),
                            "lower" => Ok(GeneratedField::Lower),
                            "upper" => Ok(GeneratedField::Upper),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ControlBounds;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ControlBounds")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ControlBounds, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut control__ = None;
                let mut lower__ = None;
                let mut upper__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Control => {
                            if control__.is_some() {
                                return Err(serde::de::Error::duplicate_field("control"));
                            }
                            control__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Lower => {
                            if lower__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lower"));
                            }
                            lower__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Upper => {
                            if upper__.is_some() {
                                return Err(serde::de::Error::duplicate_field("upper"));
                            }
                            upper__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ControlBounds {
                    control: control__.unwrap_or_default(),
                    lower: lower__.unwrap_or_default(),
                    upper: upper__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ControlBounds", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ControlPair {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.first.is_empty() {
            len += 1;
        }
        if !self.second.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ControlPair", len)?;
        if !self.first.is_empty() {
            struct_ser.serialize_field("first", &self.first)?;
        }
        if !self.second.is_empty() {
            struct_ser.serialize_field("second", &self.second)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ControlPair {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "first",
            "second",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            First,
            Second,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "first" => Ok(GeneratedField::First),
                            "second" => Ok(GeneratedField::Second),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ControlPair;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ControlPair")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ControlPair, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut first__ = None;
                let mut second__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::First => {
                            if first__.is_some() {
                                return Err(serde::de::Error::duplicate_field("first"));
                            }
                            first__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Second => {
                            if second__.is_some() {
                                return Err(serde::de::Error::duplicate_field("second"));
                            }
                            second__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ControlPair {
                    first: first__.unwrap_or_default(),
                    second: second__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ControlPair", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ControlRange {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.control.is_empty() {
            len += 1;
        }
        if self.min != 0. {
            len += 1;
        }
        if self.max != 0. {
            len += 1;
        }
        if self.out_of_range != 0. {
            len += 1;
        }
        if self.n_frames != 0 {
            len += 1;
        }
        if self.bounded.is_some() {
            len += 1;
        }
        if self.unbounded.is_some() {
            len += 1;
        }
        if self.verdict != 0 {
            len += 1;
        }
        if !self.sentence.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ControlRange", len)?;
        if !self.control.is_empty() {
            struct_ser.serialize_field("control", &self.control)?;
        }
        if self.min != 0. {
            struct_ser.serialize_field("min", &self.min)?;
        }
        if self.max != 0. {
            struct_ser.serialize_field("max", &self.max)?;
        }
        if self.out_of_range != 0. {
            struct_ser.serialize_field("outOfRange", &self.out_of_range)?;
        }
        if self.n_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nFrames", ToString::to_string(&self.n_frames).as_str())?;
        }
        if let Some(v) = self.bounded.as_ref() {
            struct_ser.serialize_field("bounded", v)?;
        }
        if let Some(v) = self.unbounded.as_ref() {
            struct_ser.serialize_field("unbounded", v)?;
        }
        if self.verdict != 0 {
            let v = RangeVerdict::try_from(self.verdict)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.verdict)))?;
            struct_ser.serialize_field("verdict", &v)?;
        }
        if !self.sentence.is_empty() {
            struct_ser.serialize_field("sentence", &self.sentence)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ControlRange {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "control",
            "min",
            "max",
            "out_of_range",
            "outOfRange",
            "n_frames",
            "nFrames",
            "bounded",
            "unbounded",
            "verdict",
            "sentence",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Control,
            Min,
            Max,
            OutOfRange,
            NFrames,
            Bounded,
            Unbounded,
            Verdict,
            Sentence,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "control" => Ok(GeneratedField::Control),
                            "min" => Ok(GeneratedField::Min),
                            "max" => Ok(GeneratedField::Max),
                            "outOfRange" | "out_of_range" => Ok(GeneratedField::OutOfRange),
                            "nFrames" | "n_frames" => Ok(GeneratedField::NFrames),
                            "bounded" => Ok(GeneratedField::Bounded),
                            "unbounded" => Ok(GeneratedField::Unbounded),
                            "verdict" => Ok(GeneratedField::Verdict),
                            "sentence" => Ok(GeneratedField::Sentence),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ControlRange;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ControlRange")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ControlRange, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut control__ = None;
                let mut min__ = None;
                let mut max__ = None;
                let mut out_of_range__ = None;
                let mut n_frames__ = None;
                let mut bounded__ = None;
                let mut unbounded__ = None;
                let mut verdict__ = None;
                let mut sentence__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Control => {
                            if control__.is_some() {
                                return Err(serde::de::Error::duplicate_field("control"));
                            }
                            control__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Min => {
                            if min__.is_some() {
                                return Err(serde::de::Error::duplicate_field("min"));
                            }
                            min__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Max => {
                            if max__.is_some() {
                                return Err(serde::de::Error::duplicate_field("max"));
                            }
                            max__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::OutOfRange => {
                            if out_of_range__.is_some() {
                                return Err(serde::de::Error::duplicate_field("outOfRange"));
                            }
                            out_of_range__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NFrames => {
                            if n_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nFrames"));
                            }
                            n_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Bounded => {
                            if bounded__.is_some() {
                                return Err(serde::de::Error::duplicate_field("bounded"));
                            }
                            bounded__ = map_.next_value()?;
                        }
                        GeneratedField::Unbounded => {
                            if unbounded__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unbounded"));
                            }
                            unbounded__ = map_.next_value()?;
                        }
                        GeneratedField::Verdict => {
                            if verdict__.is_some() {
                                return Err(serde::de::Error::duplicate_field("verdict"));
                            }
                            verdict__ = Some(map_.next_value::<RangeVerdict>()? as i32);
                        }
                        GeneratedField::Sentence => {
                            if sentence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sentence"));
                            }
                            sentence__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ControlRange {
                    control: control__.unwrap_or_default(),
                    min: min__.unwrap_or_default(),
                    max: max__.unwrap_or_default(),
                    out_of_range: out_of_range__.unwrap_or_default(),
                    n_frames: n_frames__.unwrap_or_default(),
                    bounded: bounded__,
                    unbounded: unbounded__,
                    verdict: verdict__.unwrap_or_default(),
                    sentence: sentence__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ControlRange", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ControlSpace {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "CONTROL_SPACE_UNSPECIFIED",
            Self::Muscles => "CONTROL_SPACE_MUSCLES",
            Self::Facs => "CONTROL_SPACE_FACS",
            Self::Arkit => "CONTROL_SPACE_ARKIT",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for ControlSpace {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "CONTROL_SPACE_UNSPECIFIED",
            "CONTROL_SPACE_MUSCLES",
            "CONTROL_SPACE_FACS",
            "CONTROL_SPACE_ARKIT",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = ControlSpace;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "CONTROL_SPACE_UNSPECIFIED" => Ok(ControlSpace::Unspecified),
                    "CONTROL_SPACE_MUSCLES" => Ok(ControlSpace::Muscles),
                    "CONTROL_SPACE_FACS" => Ok(ControlSpace::Facs),
                    "CONTROL_SPACE_ARKIT" => Ok(ControlSpace::Arkit),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for CreateSessionRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session_id.is_empty() {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if self.kind != 0 {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        if !self.display_name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CreateSessionRequest", len)?;
        if !self.session_id.is_empty() {
            struct_ser.serialize_field("sessionId", &self.session_id)?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if self.kind != 0 {
            let v = CaptureKind::try_from(self.kind)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.kind)))?;
            struct_ser.serialize_field("kind", &v)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        if !self.display_name.is_empty() {
            struct_ser.serialize_field("displayName", &self.display_name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CreateSessionRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session_id",
            "sessionId",
            "actor",
            "kind",
            "settings",
            "display_name",
            "displayName",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            SessionId,
            Actor,
            Kind,
            Settings,
            DisplayName,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "sessionId" | "session_id" => Ok(GeneratedField::SessionId),
                            "actor" => Ok(GeneratedField::Actor),
                            "kind" => Ok(GeneratedField::Kind),
                            "settings" => Ok(GeneratedField::Settings),
                            "displayName" | "display_name" => Ok(GeneratedField::DisplayName),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CreateSessionRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CreateSessionRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CreateSessionRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session_id__ = None;
                let mut actor__ = None;
                let mut kind__ = None;
                let mut settings__ = None;
                let mut display_name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::SessionId => {
                            if session_id__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sessionId"));
                            }
                            session_id__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Kind => {
                            if kind__.is_some() {
                                return Err(serde::de::Error::duplicate_field("kind"));
                            }
                            kind__ = Some(map_.next_value::<CaptureKind>()? as i32);
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                        GeneratedField::DisplayName => {
                            if display_name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("displayName"));
                            }
                            display_name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(CreateSessionRequest {
                    session_id: session_id__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    kind: kind__.unwrap_or_default(),
                    settings: settings__,
                    display_name: display_name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CreateSessionRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CreateSessionResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CreateSessionResponse", len)?;
        if let Some(v) = self.session.as_ref() {
            struct_ser.serialize_field("session", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CreateSessionResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CreateSessionResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CreateSessionResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CreateSessionResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = map_.next_value()?;
                        }
                    }
                }
                Ok(CreateSessionResponse {
                    session: session__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CreateSessionResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CurveEnd {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.reason.is_empty() {
            len += 1;
        }
        if self.last_frame != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CurveEnd", len)?;
        if !self.reason.is_empty() {
            struct_ser.serialize_field("reason", &self.reason)?;
        }
        if self.last_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastFrame", ToString::to_string(&self.last_frame).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CurveEnd {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "reason",
            "last_frame",
            "lastFrame",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Reason,
            LastFrame,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "reason" => Ok(GeneratedField::Reason),
                            "lastFrame" | "last_frame" => Ok(GeneratedField::LastFrame),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CurveEnd;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CurveEnd")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CurveEnd, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut reason__ = None;
                let mut last_frame__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Reason => {
                            if reason__.is_some() {
                                return Err(serde::de::Error::duplicate_field("reason"));
                            }
                            reason__ = Some(map_.next_value()?);
                        }
                        GeneratedField::LastFrame => {
                            if last_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastFrame"));
                            }
                            last_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(CurveEnd {
                    reason: reason__.unwrap_or_default(),
                    last_frame: last_frame__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CurveEnd", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CurveHeader {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if !self.muscle_set.is_empty() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if !self.controls.is_empty() {
            len += 1;
        }
        if self.nominal_rate_hz != 0. {
            len += 1;
        }
        if self.server_time_nanos != 0 {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if self.unix_offset_nanos != 0 {
            len += 1;
        }
        if self.next_sequence != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CurveHeader", len)?;
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if !self.muscle_set.is_empty() {
            struct_ser.serialize_field("muscleSet", &self.muscle_set)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if !self.controls.is_empty() {
            struct_ser.serialize_field("controls", &self.controls)?;
        }
        if self.nominal_rate_hz != 0. {
            struct_ser.serialize_field("nominalRateHz", &self.nominal_rate_hz)?;
        }
        if self.server_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("serverTimeNanos", ToString::to_string(&self.server_time_nanos).as_str())?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if self.unix_offset_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("unixOffsetNanos", ToString::to_string(&self.unix_offset_nanos).as_str())?;
        }
        if self.next_sequence != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nextSequence", ToString::to_string(&self.next_sequence).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CurveHeader {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
            "actor",
            "muscle_set",
            "muscleSet",
            "actor_revision",
            "actorRevision",
            "controls",
            "nominal_rate_hz",
            "nominalRateHz",
            "server_time_nanos",
            "serverTimeNanos",
            "run",
            "unix_offset_nanos",
            "unixOffsetNanos",
            "next_sequence",
            "nextSequence",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
            Actor,
            MuscleSet,
            ActorRevision,
            Controls,
            NominalRateHz,
            ServerTimeNanos,
            Run,
            UnixOffsetNanos,
            NextSequence,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            "actor" => Ok(GeneratedField::Actor),
                            "muscleSet" | "muscle_set" => Ok(GeneratedField::MuscleSet),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "controls" => Ok(GeneratedField::Controls),
                            "nominalRateHz" | "nominal_rate_hz" => Ok(GeneratedField::NominalRateHz),
                            "serverTimeNanos" | "server_time_nanos" => Ok(GeneratedField::ServerTimeNanos),
                            "run" => Ok(GeneratedField::Run),
                            "unixOffsetNanos" | "unix_offset_nanos" => Ok(GeneratedField::UnixOffsetNanos),
                            "nextSequence" | "next_sequence" => Ok(GeneratedField::NextSequence),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CurveHeader;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CurveHeader")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CurveHeader, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                let mut actor__ = None;
                let mut muscle_set__ = None;
                let mut actor_revision__ = None;
                let mut controls__ = None;
                let mut nominal_rate_hz__ = None;
                let mut server_time_nanos__ = None;
                let mut run__ = None;
                let mut unix_offset_nanos__ = None;
                let mut next_sequence__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::MuscleSet => {
                            if muscle_set__.is_some() {
                                return Err(serde::de::Error::duplicate_field("muscleSet"));
                            }
                            muscle_set__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Controls => {
                            if controls__.is_some() {
                                return Err(serde::de::Error::duplicate_field("controls"));
                            }
                            controls__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NominalRateHz => {
                            if nominal_rate_hz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nominalRateHz"));
                            }
                            nominal_rate_hz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ServerTimeNanos => {
                            if server_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("serverTimeNanos"));
                            }
                            server_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::UnixOffsetNanos => {
                            if unix_offset_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unixOffsetNanos"));
                            }
                            unix_offset_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NextSequence => {
                            if next_sequence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextSequence"));
                            }
                            next_sequence__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(CurveHeader {
                    session: session__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    muscle_set: muscle_set__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    controls: controls__.unwrap_or_default(),
                    nominal_rate_hz: nominal_rate_hz__.unwrap_or_default(),
                    server_time_nanos: server_time_nanos__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    unix_offset_nanos: unix_offset_nanos__.unwrap_or_default(),
                    next_sequence: next_sequence__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CurveHeader", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for CurveSample {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.frame != 0 {
            len += 1;
        }
        if self.capture_time_nanos != 0 {
            len += 1;
        }
        if self.timecode.is_some() {
            len += 1;
        }
        if !self.activations.is_empty() {
            len += 1;
        }
        if !self.standard_errors.is_empty() {
            len += 1;
        }
        if !self.region_errors.is_empty() {
            len += 1;
        }
        if self.head.is_some() {
            len += 1;
        }
        if self.quality != 0 {
            len += 1;
        }
        if self.solved_time_nanos != 0 {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if !self.coarticulation.is_empty() {
            len += 1;
        }
        if self.sequence != 0 {
            len += 1;
        }
        if self.held_frames != 0 {
            len += 1;
        }
        if self.source_frame != 0 {
            len += 1;
        }
        if !self.flags.is_empty() {
            len += 1;
        }
        if !self.unobserved.is_empty() {
            len += 1;
        }
        if self.capture_time_server_nanos != 0 {
            len += 1;
        }
        if !self.observed_cm.is_empty() {
            len += 1;
        }
        if !self.reproduced_cm.is_empty() {
            len += 1;
        }
        if !self.observed_markers.is_empty() {
            len += 1;
        }
        if !self.outlier_markers.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.CurveSample", len)?;
        if self.frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("frame", ToString::to_string(&self.frame).as_str())?;
        }
        if self.capture_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("captureTimeNanos", ToString::to_string(&self.capture_time_nanos).as_str())?;
        }
        if let Some(v) = self.timecode.as_ref() {
            struct_ser.serialize_field("timecode", v)?;
        }
        if !self.activations.is_empty() {
            struct_ser.serialize_field("activations", &self.activations)?;
        }
        if !self.standard_errors.is_empty() {
            struct_ser.serialize_field("standardErrors", &self.standard_errors)?;
        }
        if !self.region_errors.is_empty() {
            struct_ser.serialize_field("regionErrors", &self.region_errors)?;
        }
        if let Some(v) = self.head.as_ref() {
            struct_ser.serialize_field("head", v)?;
        }
        if self.quality != 0 {
            let v = Quality::try_from(self.quality)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.quality)))?;
            struct_ser.serialize_field("quality", &v)?;
        }
        if self.solved_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("solvedTimeNanos", ToString::to_string(&self.solved_time_nanos).as_str())?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if !self.coarticulation.is_empty() {
            struct_ser.serialize_field("coarticulation", &self.coarticulation)?;
        }
        if self.sequence != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("sequence", ToString::to_string(&self.sequence).as_str())?;
        }
        if self.held_frames != 0 {
            struct_ser.serialize_field("heldFrames", &self.held_frames)?;
        }
        if self.source_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("sourceFrame", ToString::to_string(&self.source_frame).as_str())?;
        }
        if !self.flags.is_empty() {
            let v = self.flags.iter().cloned().map(|v| {
                SampleFlag::try_from(v)
                    .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", v)))
                }).collect::<std::result::Result<Vec<_>, _>>()?;
            struct_ser.serialize_field("flags", &v)?;
        }
        if !self.unobserved.is_empty() {
            struct_ser.serialize_field("unobserved", &self.unobserved)?;
        }
        if self.capture_time_server_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("captureTimeServerNanos", ToString::to_string(&self.capture_time_server_nanos).as_str())?;
        }
        if !self.observed_cm.is_empty() {
            struct_ser.serialize_field("observedCm", &self.observed_cm)?;
        }
        if !self.reproduced_cm.is_empty() {
            struct_ser.serialize_field("reproducedCm", &self.reproduced_cm)?;
        }
        if !self.observed_markers.is_empty() {
            struct_ser.serialize_field("observedMarkers", &self.observed_markers)?;
        }
        if !self.outlier_markers.is_empty() {
            struct_ser.serialize_field("outlierMarkers", &self.outlier_markers)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for CurveSample {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "frame",
            "capture_time_nanos",
            "captureTimeNanos",
            "timecode",
            "activations",
            "standard_errors",
            "standardErrors",
            "region_errors",
            "regionErrors",
            "head",
            "quality",
            "solved_time_nanos",
            "solvedTimeNanos",
            "actor_revision",
            "actorRevision",
            "coarticulation",
            "sequence",
            "held_frames",
            "heldFrames",
            "source_frame",
            "sourceFrame",
            "flags",
            "unobserved",
            "capture_time_server_nanos",
            "captureTimeServerNanos",
            "observed_cm",
            "observedCm",
            "reproduced_cm",
            "reproducedCm",
            "observed_markers",
            "observedMarkers",
            "outlier_markers",
            "outlierMarkers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Frame,
            CaptureTimeNanos,
            Timecode,
            Activations,
            StandardErrors,
            RegionErrors,
            Head,
            Quality,
            SolvedTimeNanos,
            ActorRevision,
            Coarticulation,
            Sequence,
            HeldFrames,
            SourceFrame,
            Flags,
            Unobserved,
            CaptureTimeServerNanos,
            ObservedCm,
            ReproducedCm,
            ObservedMarkers,
            OutlierMarkers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "frame" => Ok(GeneratedField::Frame),
                            "captureTimeNanos" | "capture_time_nanos" => Ok(GeneratedField::CaptureTimeNanos),
                            "timecode" => Ok(GeneratedField::Timecode),
                            "activations" => Ok(GeneratedField::Activations),
                            "standardErrors" | "standard_errors" => Ok(GeneratedField::StandardErrors),
                            "regionErrors" | "region_errors" => Ok(GeneratedField::RegionErrors),
                            "head" => Ok(GeneratedField::Head),
                            "quality" => Ok(GeneratedField::Quality),
                            "solvedTimeNanos" | "solved_time_nanos" => Ok(GeneratedField::SolvedTimeNanos),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "coarticulation" => Ok(GeneratedField::Coarticulation),
                            "sequence" => Ok(GeneratedField::Sequence),
                            "heldFrames" | "held_frames" => Ok(GeneratedField::HeldFrames),
                            "sourceFrame" | "source_frame" => Ok(GeneratedField::SourceFrame),
                            "flags" => Ok(GeneratedField::Flags),
                            "unobserved" => Ok(GeneratedField::Unobserved),
                            "captureTimeServerNanos" | "capture_time_server_nanos" => Ok(GeneratedField::CaptureTimeServerNanos),
                            "observedCm" | "observed_cm" => Ok(GeneratedField::ObservedCm),
                            "reproducedCm" | "reproduced_cm" => Ok(GeneratedField::ReproducedCm),
                            "observedMarkers" | "observed_markers" => Ok(GeneratedField::ObservedMarkers),
                            "outlierMarkers" | "outlier_markers" => Ok(GeneratedField::OutlierMarkers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = CurveSample;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.CurveSample")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<CurveSample, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut frame__ = None;
                let mut capture_time_nanos__ = None;
                let mut timecode__ = None;
                let mut activations__ = None;
                let mut standard_errors__ = None;
                let mut region_errors__ = None;
                let mut head__ = None;
                let mut quality__ = None;
                let mut solved_time_nanos__ = None;
                let mut actor_revision__ = None;
                let mut coarticulation__ = None;
                let mut sequence__ = None;
                let mut held_frames__ = None;
                let mut source_frame__ = None;
                let mut flags__ = None;
                let mut unobserved__ = None;
                let mut capture_time_server_nanos__ = None;
                let mut observed_cm__ = None;
                let mut reproduced_cm__ = None;
                let mut observed_markers__ = None;
                let mut outlier_markers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Frame => {
                            if frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("frame"));
                            }
                            frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::CaptureTimeNanos => {
                            if capture_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("captureTimeNanos"));
                            }
                            capture_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Timecode => {
                            if timecode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("timecode"));
                            }
                            timecode__ = map_.next_value()?;
                        }
                        GeneratedField::Activations => {
                            if activations__.is_some() {
                                return Err(serde::de::Error::duplicate_field("activations"));
                            }
                            activations__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::StandardErrors => {
                            if standard_errors__.is_some() {
                                return Err(serde::de::Error::duplicate_field("standardErrors"));
                            }
                            standard_errors__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::RegionErrors => {
                            if region_errors__.is_some() {
                                return Err(serde::de::Error::duplicate_field("regionErrors"));
                            }
                            region_errors__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Head => {
                            if head__.is_some() {
                                return Err(serde::de::Error::duplicate_field("head"));
                            }
                            head__ = map_.next_value()?;
                        }
                        GeneratedField::Quality => {
                            if quality__.is_some() {
                                return Err(serde::de::Error::duplicate_field("quality"));
                            }
                            quality__ = Some(map_.next_value::<Quality>()? as i32);
                        }
                        GeneratedField::SolvedTimeNanos => {
                            if solved_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("solvedTimeNanos"));
                            }
                            solved_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Coarticulation => {
                            if coarticulation__.is_some() {
                                return Err(serde::de::Error::duplicate_field("coarticulation"));
                            }
                            coarticulation__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Sequence => {
                            if sequence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sequence"));
                            }
                            sequence__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::HeldFrames => {
                            if held_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("heldFrames"));
                            }
                            held_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::SourceFrame => {
                            if source_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sourceFrame"));
                            }
                            source_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Flags => {
                            if flags__.is_some() {
                                return Err(serde::de::Error::duplicate_field("flags"));
                            }
                            flags__ = Some(map_.next_value::<Vec<SampleFlag>>()?.into_iter().map(|x| x as i32).collect());
                        }
                        GeneratedField::Unobserved => {
                            if unobserved__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unobserved"));
                            }
                            unobserved__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::CaptureTimeServerNanos => {
                            if capture_time_server_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("captureTimeServerNanos"));
                            }
                            capture_time_server_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ObservedCm => {
                            if observed_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("observedCm"));
                            }
                            observed_cm__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::ReproducedCm => {
                            if reproduced_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("reproducedCm"));
                            }
                            reproduced_cm__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::ObservedMarkers => {
                            if observed_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("observedMarkers"));
                            }
                            observed_markers__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::OutlierMarkers => {
                            if outlier_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("outlierMarkers"));
                            }
                            outlier_markers__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                    }
                }
                Ok(CurveSample {
                    frame: frame__.unwrap_or_default(),
                    capture_time_nanos: capture_time_nanos__.unwrap_or_default(),
                    timecode: timecode__,
                    activations: activations__.unwrap_or_default(),
                    standard_errors: standard_errors__.unwrap_or_default(),
                    region_errors: region_errors__.unwrap_or_default(),
                    head: head__,
                    quality: quality__.unwrap_or_default(),
                    solved_time_nanos: solved_time_nanos__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    coarticulation: coarticulation__.unwrap_or_default(),
                    sequence: sequence__.unwrap_or_default(),
                    held_frames: held_frames__.unwrap_or_default(),
                    source_frame: source_frame__.unwrap_or_default(),
                    flags: flags__.unwrap_or_default(),
                    unobserved: unobserved__.unwrap_or_default(),
                    capture_time_server_nanos: capture_time_server_nanos__.unwrap_or_default(),
                    observed_cm: observed_cm__.unwrap_or_default(),
                    reproduced_cm: reproduced_cm__.unwrap_or_default(),
                    observed_markers: observed_markers__.unwrap_or_default(),
                    outlier_markers: outlier_markers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.CurveSample", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for DeleteActorRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.with_takes {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.DeleteActorRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.with_takes {
            struct_ser.serialize_field("withTakes", &self.with_takes)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for DeleteActorRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "with_takes",
            "withTakes",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            WithTakes,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "withTakes" | "with_takes" => Ok(GeneratedField::WithTakes),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = DeleteActorRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.DeleteActorRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<DeleteActorRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut with_takes__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::WithTakes => {
                            if with_takes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withTakes"));
                            }
                            with_takes__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(DeleteActorRequest {
                    name: name__.unwrap_or_default(),
                    with_takes: with_takes__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.DeleteActorRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for DeleteActorResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.receipt.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.DeleteActorResponse", len)?;
        if let Some(v) = self.receipt.as_ref() {
            struct_ser.serialize_field("receipt", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for DeleteActorResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "receipt",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Receipt,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "receipt" => Ok(GeneratedField::Receipt),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = DeleteActorResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.DeleteActorResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<DeleteActorResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut receipt__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Receipt => {
                            if receipt__.is_some() {
                                return Err(serde::de::Error::duplicate_field("receipt"));
                            }
                            receipt__ = map_.next_value()?;
                        }
                    }
                }
                Ok(DeleteActorResponse {
                    receipt: receipt__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.DeleteActorResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for DeleteTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.DeleteTakeRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for DeleteTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = DeleteTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.DeleteTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<DeleteTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(DeleteTakeRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.DeleteTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for DeleteTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let len = 0;
        let struct_ser = serializer.serialize_struct("frontalis.v1.DeleteTakeResponse", len)?;
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for DeleteTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                            Err(serde::de::Error::unknown_field(value, FIELDS))
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = DeleteTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.DeleteTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<DeleteTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                while map_.next_key::<GeneratedField>()?.is_some() {
                    let _ = map_.next_value::<serde::de::IgnoredAny>()?;
                }
                Ok(DeleteTakeResponse {
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.DeleteTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Delivery {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "DELIVERY_UNSPECIFIED",
            Self::Latest => "DELIVERY_LATEST",
            Self::EveryFrame => "DELIVERY_EVERY_FRAME",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for Delivery {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "DELIVERY_UNSPECIFIED",
            "DELIVERY_LATEST",
            "DELIVERY_EVERY_FRAME",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = Delivery;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "DELIVERY_UNSPECIFIED" => Ok(Delivery::Unspecified),
                    "DELIVERY_LATEST" => Ok(Delivery::Latest),
                    "DELIVERY_EVERY_FRAME" => Ok(Delivery::EveryFrame),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for EndSessionRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.EndSessionRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for EndSessionRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = EndSessionRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.EndSessionRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<EndSessionRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(EndSessionRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.EndSessionRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for EndSessionResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.EndSessionResponse", len)?;
        if let Some(v) = self.session.as_ref() {
            struct_ser.serialize_field("session", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for EndSessionResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = EndSessionResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.EndSessionResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<EndSessionResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = map_.next_value()?;
                        }
                    }
                }
                Ok(EndSessionResponse {
                    session: session__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.EndSessionResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ErasureReceipt {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.actor.is_empty() {
            len += 1;
        }
        if self.erase_time.is_some() {
            len += 1;
        }
        if self.n_revisions != 0 {
            len += 1;
        }
        if self.n_sessions != 0 {
            len += 1;
        }
        if self.n_takes != 0 {
            len += 1;
        }
        if self.n_bytes != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ErasureReceipt", len)?;
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if let Some(v) = self.erase_time.as_ref() {
            struct_ser.serialize_field("eraseTime", v)?;
        }
        if self.n_revisions != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nRevisions", ToString::to_string(&self.n_revisions).as_str())?;
        }
        if self.n_sessions != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nSessions", ToString::to_string(&self.n_sessions).as_str())?;
        }
        if self.n_takes != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nTakes", ToString::to_string(&self.n_takes).as_str())?;
        }
        if self.n_bytes != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nBytes", ToString::to_string(&self.n_bytes).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ErasureReceipt {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor",
            "erase_time",
            "eraseTime",
            "n_revisions",
            "nRevisions",
            "n_sessions",
            "nSessions",
            "n_takes",
            "nTakes",
            "n_bytes",
            "nBytes",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actor,
            EraseTime,
            NRevisions,
            NSessions,
            NTakes,
            NBytes,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actor" => Ok(GeneratedField::Actor),
                            "eraseTime" | "erase_time" => Ok(GeneratedField::EraseTime),
                            "nRevisions" | "n_revisions" => Ok(GeneratedField::NRevisions),
                            "nSessions" | "n_sessions" => Ok(GeneratedField::NSessions),
                            "nTakes" | "n_takes" => Ok(GeneratedField::NTakes),
                            "nBytes" | "n_bytes" => Ok(GeneratedField::NBytes),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ErasureReceipt;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ErasureReceipt")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ErasureReceipt, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor__ = None;
                let mut erase_time__ = None;
                let mut n_revisions__ = None;
                let mut n_sessions__ = None;
                let mut n_takes__ = None;
                let mut n_bytes__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::EraseTime => {
                            if erase_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("eraseTime"));
                            }
                            erase_time__ = map_.next_value()?;
                        }
                        GeneratedField::NRevisions => {
                            if n_revisions__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nRevisions"));
                            }
                            n_revisions__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NSessions => {
                            if n_sessions__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nSessions"));
                            }
                            n_sessions__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NTakes => {
                            if n_takes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nTakes"));
                            }
                            n_takes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NBytes => {
                            if n_bytes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nBytes"));
                            }
                            n_bytes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ErasureReceipt {
                    actor: actor__.unwrap_or_default(),
                    erase_time: erase_time__,
                    n_revisions: n_revisions__.unwrap_or_default(),
                    n_sessions: n_sessions__.unwrap_or_default(),
                    n_takes: n_takes__.unwrap_or_default(),
                    n_bytes: n_bytes__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ErasureReceipt", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ExportActorRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.revision != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ExportActorRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.revision != 0 {
            struct_ser.serialize_field("revision", &self.revision)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ExportActorRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "revision",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Revision,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "revision" => Ok(GeneratedField::Revision),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ExportActorRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ExportActorRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ExportActorRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut revision__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Revision => {
                            if revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("revision"));
                            }
                            revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ExportActorRequest {
                    name: name__.unwrap_or_default(),
                    revision: revision__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ExportActorRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ExportActorResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.chunk.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ExportActorResponse", len)?;
        if !self.chunk.is_empty() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("chunk", pbjson::private::base64::encode(&self.chunk).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ExportActorResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "chunk",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Chunk,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "chunk" => Ok(GeneratedField::Chunk),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ExportActorResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ExportActorResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ExportActorResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut chunk__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Chunk => {
                            if chunk__.is_some() {
                                return Err(serde::de::Error::duplicate_field("chunk"));
                            }
                            chunk__ = 
                                Some(map_.next_value::<::pbjson::private::BytesDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ExportActorResponse {
                    chunk: chunk__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ExportActorResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ExportTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.format != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ExportTakeRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.format != 0 {
            let v = TakeFormat::try_from(self.format)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.format)))?;
            struct_ser.serialize_field("format", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ExportTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "format",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Format,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "format" => Ok(GeneratedField::Format),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ExportTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ExportTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ExportTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut format__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Format => {
                            if format__.is_some() {
                                return Err(serde::de::Error::duplicate_field("format"));
                            }
                            format__ = Some(map_.next_value::<TakeFormat>()? as i32);
                        }
                    }
                }
                Ok(ExportTakeRequest {
                    name: name__.unwrap_or_default(),
                    format: format__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ExportTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ExportTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.chunk.is_empty() {
            len += 1;
        }
        if self.frames_done != 0 {
            len += 1;
        }
        if self.export.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ExportTakeResponse", len)?;
        if !self.chunk.is_empty() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("chunk", pbjson::private::base64::encode(&self.chunk).as_str())?;
        }
        if self.frames_done != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesDone", ToString::to_string(&self.frames_done).as_str())?;
        }
        if let Some(v) = self.export.as_ref() {
            struct_ser.serialize_field("export", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ExportTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "chunk",
            "frames_done",
            "framesDone",
            "export",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Chunk,
            FramesDone,
            Export,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "chunk" => Ok(GeneratedField::Chunk),
                            "framesDone" | "frames_done" => Ok(GeneratedField::FramesDone),
                            "export" => Ok(GeneratedField::Export),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ExportTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ExportTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ExportTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut chunk__ = None;
                let mut frames_done__ = None;
                let mut export__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Chunk => {
                            if chunk__.is_some() {
                                return Err(serde::de::Error::duplicate_field("chunk"));
                            }
                            chunk__ = 
                                Some(map_.next_value::<::pbjson::private::BytesDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FramesDone => {
                            if frames_done__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesDone"));
                            }
                            frames_done__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Export => {
                            if export__.is_some() {
                                return Err(serde::de::Error::duplicate_field("export"));
                            }
                            export__ = map_.next_value()?;
                        }
                    }
                }
                Ok(ExportTakeResponse {
                    chunk: chunk__.unwrap_or_default(),
                    frames_done: frames_done__.unwrap_or_default(),
                    export: export__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ExportTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for FaceRegion {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "FACE_REGION_UNSPECIFIED",
            Self::Upper => "FACE_REGION_UPPER",
            Self::Lower => "FACE_REGION_LOWER",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for FaceRegion {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "FACE_REGION_UNSPECIFIED",
            "FACE_REGION_UPPER",
            "FACE_REGION_LOWER",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = FaceRegion;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "FACE_REGION_UNSPECIFIED" => Ok(FaceRegion::Unspecified),
                    "FACE_REGION_UPPER" => Ok(FaceRegion::Upper),
                    "FACE_REGION_LOWER" => Ok(FaceRegion::Lower),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for Gap {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.first != 0 {
            len += 1;
        }
        if self.last != 0 {
            len += 1;
        }
        if self.cause != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Gap", len)?;
        if self.first != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("first", ToString::to_string(&self.first).as_str())?;
        }
        if self.last != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("last", ToString::to_string(&self.last).as_str())?;
        }
        if self.cause != 0 {
            let v = GapCause::try_from(self.cause)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.cause)))?;
            struct_ser.serialize_field("cause", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Gap {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "first",
            "last",
            "cause",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            First,
            Last,
            Cause,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "first" => Ok(GeneratedField::First),
                            "last" => Ok(GeneratedField::Last),
                            "cause" => Ok(GeneratedField::Cause),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Gap;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Gap")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Gap, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut first__ = None;
                let mut last__ = None;
                let mut cause__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::First => {
                            if first__.is_some() {
                                return Err(serde::de::Error::duplicate_field("first"));
                            }
                            first__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Last => {
                            if last__.is_some() {
                                return Err(serde::de::Error::duplicate_field("last"));
                            }
                            last__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Cause => {
                            if cause__.is_some() {
                                return Err(serde::de::Error::duplicate_field("cause"));
                            }
                            cause__ = Some(map_.next_value::<GapCause>()? as i32);
                        }
                    }
                }
                Ok(Gap {
                    first: first__.unwrap_or_default(),
                    last: last__.unwrap_or_default(),
                    cause: cause__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Gap", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GapCause {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "GAP_CAUSE_UNSPECIFIED",
            Self::CaptureSkip => "GAP_CAUSE_CAPTURE_SKIP",
            Self::Rejected => "GAP_CAUSE_REJECTED",
            Self::Shed => "GAP_CAUSE_SHED",
            Self::PublisherChange => "GAP_CAUSE_PUBLISHER_CHANGE",
            Self::Corrupt => "GAP_CAUSE_CORRUPT",
            Self::NotAligned => "GAP_CAUSE_NOT_ALIGNED",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for GapCause {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "GAP_CAUSE_UNSPECIFIED",
            "GAP_CAUSE_CAPTURE_SKIP",
            "GAP_CAUSE_REJECTED",
            "GAP_CAUSE_SHED",
            "GAP_CAUSE_PUBLISHER_CHANGE",
            "GAP_CAUSE_CORRUPT",
            "GAP_CAUSE_NOT_ALIGNED",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = GapCause;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "GAP_CAUSE_UNSPECIFIED" => Ok(GapCause::Unspecified),
                    "GAP_CAUSE_CAPTURE_SKIP" => Ok(GapCause::CaptureSkip),
                    "GAP_CAUSE_REJECTED" => Ok(GapCause::Rejected),
                    "GAP_CAUSE_SHED" => Ok(GapCause::Shed),
                    "GAP_CAUSE_PUBLISHER_CHANGE" => Ok(GapCause::PublisherChange),
                    "GAP_CAUSE_CORRUPT" => Ok(GapCause::Corrupt),
                    "GAP_CAUSE_NOT_ALIGNED" => Ok(GapCause::NotAligned),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for GetActorRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetActorRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetActorRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetActorRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetActorRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetActorRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(GetActorRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetActorRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetActorResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.actor.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetActorResponse", len)?;
        if let Some(v) = self.actor.as_ref() {
            struct_ser.serialize_field("actor", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetActorResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actor,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actor" => Ok(GeneratedField::Actor),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetActorResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetActorResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetActorResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = map_.next_value()?;
                        }
                    }
                }
                Ok(GetActorResponse {
                    actor: actor__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetActorResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetServerRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let len = 0;
        let struct_ser = serializer.serialize_struct("frontalis.v1.GetServerRequest", len)?;
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetServerRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                            Err(serde::de::Error::unknown_field(value, FIELDS))
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetServerRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetServerRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetServerRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                while map_.next_key::<GeneratedField>()?.is_some() {
                    let _ = map_.next_value::<serde::de::IgnoredAny>()?;
                }
                Ok(GetServerRequest {
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetServerRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetServerResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.server.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetServerResponse", len)?;
        if let Some(v) = self.server.as_ref() {
            struct_ser.serialize_field("server", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetServerResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "server",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Server,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "server" => Ok(GeneratedField::Server),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetServerResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetServerResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetServerResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut server__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Server => {
                            if server__.is_some() {
                                return Err(serde::de::Error::duplicate_field("server"));
                            }
                            server__ = map_.next_value()?;
                        }
                    }
                }
                Ok(GetServerResponse {
                    server: server__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetServerResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetSessionRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetSessionRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetSessionRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetSessionRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetSessionRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetSessionRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(GetSessionRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetSessionRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetSessionResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetSessionResponse", len)?;
        if let Some(v) = self.session.as_ref() {
            struct_ser.serialize_field("session", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetSessionResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetSessionResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetSessionResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetSessionResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = map_.next_value()?;
                        }
                    }
                }
                Ok(GetSessionResponse {
                    session: session__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetSessionResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetTakeRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(GetTakeRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for GetTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.take.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.GetTakeResponse", len)?;
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for GetTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = GetTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.GetTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<GetTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                    }
                }
                Ok(GetTakeResponse {
                    take: take__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.GetTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for HeadPose {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.qx != 0. {
            len += 1;
        }
        if self.qy != 0. {
            len += 1;
        }
        if self.qz != 0. {
            len += 1;
        }
        if self.qw != 0. {
            len += 1;
        }
        if self.tx_cm != 0. {
            len += 1;
        }
        if self.ty_cm != 0. {
            len += 1;
        }
        if self.tz_cm != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.HeadPose", len)?;
        if self.qx != 0. {
            struct_ser.serialize_field("qx", &self.qx)?;
        }
        if self.qy != 0. {
            struct_ser.serialize_field("qy", &self.qy)?;
        }
        if self.qz != 0. {
            struct_ser.serialize_field("qz", &self.qz)?;
        }
        if self.qw != 0. {
            struct_ser.serialize_field("qw", &self.qw)?;
        }
        if self.tx_cm != 0. {
            struct_ser.serialize_field("txCm", &self.tx_cm)?;
        }
        if self.ty_cm != 0. {
            struct_ser.serialize_field("tyCm", &self.ty_cm)?;
        }
        if self.tz_cm != 0. {
            struct_ser.serialize_field("tzCm", &self.tz_cm)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for HeadPose {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "qx",
            "qy",
            "qz",
            "qw",
            "tx_cm",
            "txCm",
            "ty_cm",
            "tyCm",
            "tz_cm",
            "tzCm",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Qx,
            Qy,
            Qz,
            Qw,
            TxCm,
            TyCm,
            TzCm,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "qx" => Ok(GeneratedField::Qx),
                            "qy" => Ok(GeneratedField::Qy),
                            "qz" => Ok(GeneratedField::Qz),
                            "qw" => Ok(GeneratedField::Qw),
                            "txCm" | "tx_cm" => Ok(GeneratedField::TxCm),
                            "tyCm" | "ty_cm" => Ok(GeneratedField::TyCm),
                            "tzCm" | "tz_cm" => Ok(GeneratedField::TzCm),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = HeadPose;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.HeadPose")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<HeadPose, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut qx__ = None;
                let mut qy__ = None;
                let mut qz__ = None;
                let mut qw__ = None;
                let mut tx_cm__ = None;
                let mut ty_cm__ = None;
                let mut tz_cm__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Qx => {
                            if qx__.is_some() {
                                return Err(serde::de::Error::duplicate_field("qx"));
                            }
                            qx__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Qy => {
                            if qy__.is_some() {
                                return Err(serde::de::Error::duplicate_field("qy"));
                            }
                            qy__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Qz => {
                            if qz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("qz"));
                            }
                            qz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Qw => {
                            if qw__.is_some() {
                                return Err(serde::de::Error::duplicate_field("qw"));
                            }
                            qw__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::TxCm => {
                            if tx_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("txCm"));
                            }
                            tx_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::TyCm => {
                            if ty_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("tyCm"));
                            }
                            ty_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::TzCm => {
                            if tz_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("tzCm"));
                            }
                            tz_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(HeadPose {
                    qx: qx__.unwrap_or_default(),
                    qy: qy__.unwrap_or_default(),
                    qz: qz__.unwrap_or_default(),
                    qw: qw__.unwrap_or_default(),
                    tx_cm: tx_cm__.unwrap_or_default(),
                    ty_cm: ty_cm__.unwrap_or_default(),
                    tz_cm: tz_cm__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.HeadPose", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImageEncoding {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "IMAGE_ENCODING_UNSPECIFIED",
            Self::Gray8 => "IMAGE_ENCODING_GRAY8",
            Self::Jpeg => "IMAGE_ENCODING_JPEG",
            Self::Png => "IMAGE_ENCODING_PNG",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for ImageEncoding {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "IMAGE_ENCODING_UNSPECIFIED",
            "IMAGE_ENCODING_GRAY8",
            "IMAGE_ENCODING_JPEG",
            "IMAGE_ENCODING_PNG",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = ImageEncoding;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "IMAGE_ENCODING_UNSPECIFIED" => Ok(ImageEncoding::Unspecified),
                    "IMAGE_ENCODING_GRAY8" => Ok(ImageEncoding::Gray8),
                    "IMAGE_ENCODING_JPEG" => Ok(ImageEncoding::Jpeg),
                    "IMAGE_ENCODING_PNG" => Ok(ImageEncoding::Png),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for ImageFormat {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.encoding != 0 {
            len += 1;
        }
        if self.width != 0 {
            len += 1;
        }
        if self.height != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImageFormat", len)?;
        if self.encoding != 0 {
            let v = ImageEncoding::try_from(self.encoding)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.encoding)))?;
            struct_ser.serialize_field("encoding", &v)?;
        }
        if self.width != 0 {
            struct_ser.serialize_field("width", &self.width)?;
        }
        if self.height != 0 {
            struct_ser.serialize_field("height", &self.height)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImageFormat {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "encoding",
            "width",
            "height",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Encoding,
            Width,
            Height,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "encoding" => Ok(GeneratedField::Encoding),
                            "width" => Ok(GeneratedField::Width),
                            "height" => Ok(GeneratedField::Height),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImageFormat;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImageFormat")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImageFormat, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut encoding__ = None;
                let mut width__ = None;
                let mut height__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Encoding => {
                            if encoding__.is_some() {
                                return Err(serde::de::Error::duplicate_field("encoding"));
                            }
                            encoding__ = Some(map_.next_value::<ImageEncoding>()? as i32);
                        }
                        GeneratedField::Width => {
                            if width__.is_some() {
                                return Err(serde::de::Error::duplicate_field("width"));
                            }
                            width__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Height => {
                            if height__.is_some() {
                                return Err(serde::de::Error::duplicate_field("height"));
                            }
                            height__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ImageFormat {
                    encoding: encoding__.unwrap_or_default(),
                    width: width__.unwrap_or_default(),
                    height: height__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImageFormat", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImageFrame {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.number != 0 {
            len += 1;
        }
        if self.capture_time_nanos != 0 {
            len += 1;
        }
        if self.timecode.is_some() {
            len += 1;
        }
        if !self.data.is_empty() {
            len += 1;
        }
        if self.source_frame != 0 {
            len += 1;
        }
        if self.crc32c.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImageFrame", len)?;
        if self.number != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("number", ToString::to_string(&self.number).as_str())?;
        }
        if self.capture_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("captureTimeNanos", ToString::to_string(&self.capture_time_nanos).as_str())?;
        }
        if let Some(v) = self.timecode.as_ref() {
            struct_ser.serialize_field("timecode", v)?;
        }
        if !self.data.is_empty() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("data", pbjson::private::base64::encode(&self.data).as_str())?;
        }
        if self.source_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("sourceFrame", ToString::to_string(&self.source_frame).as_str())?;
        }
        if let Some(v) = self.crc32c.as_ref() {
            struct_ser.serialize_field("crc32c", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImageFrame {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "number",
            "capture_time_nanos",
            "captureTimeNanos",
            "timecode",
            "data",
            "source_frame",
            "sourceFrame",
            "crc32c",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Number,
            CaptureTimeNanos,
            Timecode,
            Data,
            SourceFrame,
            Crc32c,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "number" => Ok(GeneratedField::Number),
                            "captureTimeNanos" | "capture_time_nanos" => Ok(GeneratedField::CaptureTimeNanos),
                            "timecode" => Ok(GeneratedField::Timecode),
                            "data" => Ok(GeneratedField::Data),
                            "sourceFrame" | "source_frame" => Ok(GeneratedField::SourceFrame),
                            "crc32c" => Ok(GeneratedField::Crc32c),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImageFrame;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImageFrame")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImageFrame, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut number__ = None;
                let mut capture_time_nanos__ = None;
                let mut timecode__ = None;
                let mut data__ = None;
                let mut source_frame__ = None;
                let mut crc32c__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::CaptureTimeNanos => {
                            if capture_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("captureTimeNanos"));
                            }
                            capture_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Timecode => {
                            if timecode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("timecode"));
                            }
                            timecode__ = map_.next_value()?;
                        }
                        GeneratedField::Data => {
                            if data__.is_some() {
                                return Err(serde::de::Error::duplicate_field("data"));
                            }
                            data__ = 
                                Some(map_.next_value::<::pbjson::private::BytesDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::SourceFrame => {
                            if source_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sourceFrame"));
                            }
                            source_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Crc32c => {
                            if crc32c__.is_some() {
                                return Err(serde::de::Error::duplicate_field("crc32c"));
                            }
                            crc32c__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                    }
                }
                Ok(ImageFrame {
                    number: number__.unwrap_or_default(),
                    capture_time_nanos: capture_time_nanos__.unwrap_or_default(),
                    timecode: timecode__,
                    data: data__.unwrap_or_default(),
                    source_frame: source_frame__.unwrap_or_default(),
                    crc32c: crc32c__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImageFrame", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImportActorRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.start.is_some() {
            len += 1;
        }
        if !self.chunk.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImportActorRequest", len)?;
        if let Some(v) = self.start.as_ref() {
            struct_ser.serialize_field("start", v)?;
        }
        if !self.chunk.is_empty() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("chunk", pbjson::private::base64::encode(&self.chunk).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImportActorRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "start",
            "chunk",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Start,
            Chunk,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "start" => Ok(GeneratedField::Start),
                            "chunk" => Ok(GeneratedField::Chunk),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImportActorRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImportActorRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImportActorRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut start__ = None;
                let mut chunk__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Start => {
                            if start__.is_some() {
                                return Err(serde::de::Error::duplicate_field("start"));
                            }
                            start__ = map_.next_value()?;
                        }
                        GeneratedField::Chunk => {
                            if chunk__.is_some() {
                                return Err(serde::de::Error::duplicate_field("chunk"));
                            }
                            chunk__ = 
                                Some(map_.next_value::<::pbjson::private::BytesDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(ImportActorRequest {
                    start: start__,
                    chunk: chunk__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImportActorRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImportActorResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.actor.is_some() {
            len += 1;
        }
        if !self.warnings.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImportActorResponse", len)?;
        if let Some(v) = self.actor.as_ref() {
            struct_ser.serialize_field("actor", v)?;
        }
        if !self.warnings.is_empty() {
            struct_ser.serialize_field("warnings", &self.warnings)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImportActorResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor",
            "warnings",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actor,
            Warnings,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actor" => Ok(GeneratedField::Actor),
                            "warnings" => Ok(GeneratedField::Warnings),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImportActorResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImportActorResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImportActorResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor__ = None;
                let mut warnings__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = map_.next_value()?;
                        }
                        GeneratedField::Warnings => {
                            if warnings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("warnings"));
                            }
                            warnings__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ImportActorResponse {
                    actor: actor__,
                    warnings: warnings__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImportActorResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImportActorStart {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.actor_id.is_empty() {
            len += 1;
        }
        if !self.display_name.is_empty() {
            len += 1;
        }
        if self.unit != 0 {
            len += 1;
        }
        if self.regularize {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImportActorStart", len)?;
        if !self.actor_id.is_empty() {
            struct_ser.serialize_field("actorId", &self.actor_id)?;
        }
        if !self.display_name.is_empty() {
            struct_ser.serialize_field("displayName", &self.display_name)?;
        }
        if self.unit != 0 {
            let v = LengthUnit::try_from(self.unit)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.unit)))?;
            struct_ser.serialize_field("unit", &v)?;
        }
        if self.regularize {
            struct_ser.serialize_field("regularize", &self.regularize)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImportActorStart {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor_id",
            "actorId",
            "display_name",
            "displayName",
            "unit",
            "regularize",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            ActorId,
            DisplayName,
            Unit,
            Regularize,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actorId" | "actor_id" => Ok(GeneratedField::ActorId),
                            "displayName" | "display_name" => Ok(GeneratedField::DisplayName),
                            "unit" => Ok(GeneratedField::Unit),
                            "regularize" => Ok(GeneratedField::Regularize),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImportActorStart;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImportActorStart")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImportActorStart, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor_id__ = None;
                let mut display_name__ = None;
                let mut unit__ = None;
                let mut regularize__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::ActorId => {
                            if actor_id__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorId"));
                            }
                            actor_id__ = Some(map_.next_value()?);
                        }
                        GeneratedField::DisplayName => {
                            if display_name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("displayName"));
                            }
                            display_name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Unit => {
                            if unit__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unit"));
                            }
                            unit__ = Some(map_.next_value::<LengthUnit>()? as i32);
                        }
                        GeneratedField::Regularize => {
                            if regularize__.is_some() {
                                return Err(serde::de::Error::duplicate_field("regularize"));
                            }
                            regularize__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ImportActorStart {
                    actor_id: actor_id__.unwrap_or_default(),
                    display_name: display_name__.unwrap_or_default(),
                    unit: unit__.unwrap_or_default(),
                    regularize: regularize__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImportActorStart", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImproveBasisRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.actor.is_empty() {
            len += 1;
        }
        if !self.takes.is_empty() {
            len += 1;
        }
        if self.max_iterations != 0 {
            len += 1;
        }
        if self.relative_tolerance != 0. {
            len += 1;
        }
        if self.draft_weight != 0. {
            len += 1;
        }
        if self.method != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImproveBasisRequest", len)?;
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if !self.takes.is_empty() {
            struct_ser.serialize_field("takes", &self.takes)?;
        }
        if self.max_iterations != 0 {
            struct_ser.serialize_field("maxIterations", &self.max_iterations)?;
        }
        if self.relative_tolerance != 0. {
            struct_ser.serialize_field("relativeTolerance", &self.relative_tolerance)?;
        }
        if self.draft_weight != 0. {
            struct_ser.serialize_field("draftWeight", &self.draft_weight)?;
        }
        if self.method != 0 {
            let v = ImproveMethod::try_from(self.method)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.method)))?;
            struct_ser.serialize_field("method", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImproveBasisRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor",
            "takes",
            "max_iterations",
            "maxIterations",
            "relative_tolerance",
            "relativeTolerance",
            "draft_weight",
            "draftWeight",
            "method",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actor,
            Takes,
            MaxIterations,
            RelativeTolerance,
            DraftWeight,
            Method,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actor" => Ok(GeneratedField::Actor),
                            "takes" => Ok(GeneratedField::Takes),
                            "maxIterations" | "max_iterations" => Ok(GeneratedField::MaxIterations),
                            "relativeTolerance" | "relative_tolerance" => Ok(GeneratedField::RelativeTolerance),
                            "draftWeight" | "draft_weight" => Ok(GeneratedField::DraftWeight),
                            "method" => Ok(GeneratedField::Method),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImproveBasisRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImproveBasisRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImproveBasisRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor__ = None;
                let mut takes__ = None;
                let mut max_iterations__ = None;
                let mut relative_tolerance__ = None;
                let mut draft_weight__ = None;
                let mut method__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Takes => {
                            if takes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("takes"));
                            }
                            takes__ = Some(map_.next_value()?);
                        }
                        GeneratedField::MaxIterations => {
                            if max_iterations__.is_some() {
                                return Err(serde::de::Error::duplicate_field("maxIterations"));
                            }
                            max_iterations__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RelativeTolerance => {
                            if relative_tolerance__.is_some() {
                                return Err(serde::de::Error::duplicate_field("relativeTolerance"));
                            }
                            relative_tolerance__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::DraftWeight => {
                            if draft_weight__.is_some() {
                                return Err(serde::de::Error::duplicate_field("draftWeight"));
                            }
                            draft_weight__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Method => {
                            if method__.is_some() {
                                return Err(serde::de::Error::duplicate_field("method"));
                            }
                            method__ = Some(map_.next_value::<ImproveMethod>()? as i32);
                        }
                    }
                }
                Ok(ImproveBasisRequest {
                    actor: actor__.unwrap_or_default(),
                    takes: takes__.unwrap_or_default(),
                    max_iterations: max_iterations__.unwrap_or_default(),
                    relative_tolerance: relative_tolerance__.unwrap_or_default(),
                    draft_weight: draft_weight__.unwrap_or_default(),
                    method: method__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImproveBasisRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImproveBasisResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.iteration != 0 {
            len += 1;
        }
        if self.total_error_cm2 != 0. {
            len += 1;
        }
        if self.mean_marker_error_cm != 0. {
            len += 1;
        }
        if self.actor.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ImproveBasisResponse", len)?;
        if self.iteration != 0 {
            struct_ser.serialize_field("iteration", &self.iteration)?;
        }
        if self.total_error_cm2 != 0. {
            struct_ser.serialize_field("totalErrorCm2", &self.total_error_cm2)?;
        }
        if self.mean_marker_error_cm != 0. {
            struct_ser.serialize_field("meanMarkerErrorCm", &self.mean_marker_error_cm)?;
        }
        if let Some(v) = self.actor.as_ref() {
            struct_ser.serialize_field("actor", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ImproveBasisResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "iteration",
            "total_error_cm2",
            "totalErrorCm2",
            "mean_marker_error_cm",
            "meanMarkerErrorCm",
            "actor",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Iteration,
            TotalErrorCm2,
            MeanMarkerErrorCm,
            Actor,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "iteration" => Ok(GeneratedField::Iteration),
                            "totalErrorCm2" | "total_error_cm2" => Ok(GeneratedField::TotalErrorCm2),
                            "meanMarkerErrorCm" | "mean_marker_error_cm" => Ok(GeneratedField::MeanMarkerErrorCm),
                            "actor" => Ok(GeneratedField::Actor),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ImproveBasisResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ImproveBasisResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ImproveBasisResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut iteration__ = None;
                let mut total_error_cm2__ = None;
                let mut mean_marker_error_cm__ = None;
                let mut actor__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Iteration => {
                            if iteration__.is_some() {
                                return Err(serde::de::Error::duplicate_field("iteration"));
                            }
                            iteration__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::TotalErrorCm2 => {
                            if total_error_cm2__.is_some() {
                                return Err(serde::de::Error::duplicate_field("totalErrorCm2"));
                            }
                            total_error_cm2__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::MeanMarkerErrorCm => {
                            if mean_marker_error_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("meanMarkerErrorCm"));
                            }
                            mean_marker_error_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = map_.next_value()?;
                        }
                    }
                }
                Ok(ImproveBasisResponse {
                    iteration: iteration__.unwrap_or_default(),
                    total_error_cm2: total_error_cm2__.unwrap_or_default(),
                    mean_marker_error_cm: mean_marker_error_cm__.unwrap_or_default(),
                    actor: actor__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ImproveBasisResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ImproveMethod {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "IMPROVE_METHOD_UNSPECIFIED",
            Self::Paper => "IMPROVE_METHOD_PAPER",
            Self::Posterior => "IMPROVE_METHOD_POSTERIOR",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for ImproveMethod {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "IMPROVE_METHOD_UNSPECIFIED",
            "IMPROVE_METHOD_PAPER",
            "IMPROVE_METHOD_POSTERIOR",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = ImproveMethod;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "IMPROVE_METHOD_UNSPECIFIED" => Ok(ImproveMethod::Unspecified),
                    "IMPROVE_METHOD_PAPER" => Ok(ImproveMethod::Paper),
                    "IMPROVE_METHOD_POSTERIOR" => Ok(ImproveMethod::Posterior),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for Ingest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "INGEST_UNSPECIFIED",
            Self::Live => "INGEST_LIVE",
            Self::Lossless => "INGEST_LOSSLESS",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for Ingest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "INGEST_UNSPECIFIED",
            "INGEST_LIVE",
            "INGEST_LOSSLESS",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = Ingest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "INGEST_UNSPECIFIED" => Ok(Ingest::Unspecified),
                    "INGEST_LIVE" => Ok(Ingest::Live),
                    "INGEST_LOSSLESS" => Ok(Ingest::Lossless),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for Latency {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.p50_micros != 0. {
            len += 1;
        }
        if self.p99_micros != 0. {
            len += 1;
        }
        if self.max_micros != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Latency", len)?;
        if self.p50_micros != 0. {
            struct_ser.serialize_field("p50Micros", &self.p50_micros)?;
        }
        if self.p99_micros != 0. {
            struct_ser.serialize_field("p99Micros", &self.p99_micros)?;
        }
        if self.max_micros != 0. {
            struct_ser.serialize_field("maxMicros", &self.max_micros)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Latency {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "p50_micros",
            "p50Micros",
            "p99_micros",
            "p99Micros",
            "max_micros",
            "maxMicros",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            P50Micros,
            P99Micros,
            MaxMicros,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "p50Micros" | "p50_micros" => Ok(GeneratedField::P50Micros),
                            "p99Micros" | "p99_micros" => Ok(GeneratedField::P99Micros),
                            "maxMicros" | "max_micros" => Ok(GeneratedField::MaxMicros),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Latency;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Latency")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Latency, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut p50_micros__ = None;
                let mut p99_micros__ = None;
                let mut max_micros__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::P50Micros => {
                            if p50_micros__.is_some() {
                                return Err(serde::de::Error::duplicate_field("p50Micros"));
                            }
                            p50_micros__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::P99Micros => {
                            if p99_micros__.is_some() {
                                return Err(serde::de::Error::duplicate_field("p99Micros"));
                            }
                            p99_micros__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::MaxMicros => {
                            if max_micros__.is_some() {
                                return Err(serde::de::Error::duplicate_field("maxMicros"));
                            }
                            max_micros__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(Latency {
                    p50_micros: p50_micros__.unwrap_or_default(),
                    p99_micros: p99_micros__.unwrap_or_default(),
                    max_micros: max_micros__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Latency", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for LengthUnit {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "LENGTH_UNIT_UNSPECIFIED",
            Self::Millimeter => "LENGTH_UNIT_MILLIMETER",
            Self::Centimeter => "LENGTH_UNIT_CENTIMETER",
            Self::Meter => "LENGTH_UNIT_METER",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for LengthUnit {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "LENGTH_UNIT_UNSPECIFIED",
            "LENGTH_UNIT_MILLIMETER",
            "LENGTH_UNIT_CENTIMETER",
            "LENGTH_UNIT_METER",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = LengthUnit;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "LENGTH_UNIT_UNSPECIFIED" => Ok(LengthUnit::Unspecified),
                    "LENGTH_UNIT_MILLIMETER" => Ok(LengthUnit::Millimeter),
                    "LENGTH_UNIT_CENTIMETER" => Ok(LengthUnit::Centimeter),
                    "LENGTH_UNIT_METER" => Ok(LengthUnit::Meter),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for ListActorsRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.page_size != 0 {
            len += 1;
        }
        if !self.page_token.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListActorsRequest", len)?;
        if self.page_size != 0 {
            struct_ser.serialize_field("pageSize", &self.page_size)?;
        }
        if !self.page_token.is_empty() {
            struct_ser.serialize_field("pageToken", &self.page_token)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListActorsRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "page_size",
            "pageSize",
            "page_token",
            "pageToken",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            PageSize,
            PageToken,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "pageSize" | "page_size" => Ok(GeneratedField::PageSize),
                            "pageToken" | "page_token" => Ok(GeneratedField::PageToken),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListActorsRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListActorsRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListActorsRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut page_size__ = None;
                let mut page_token__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::PageSize => {
                            if page_size__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageSize"));
                            }
                            page_size__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::PageToken => {
                            if page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageToken"));
                            }
                            page_token__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListActorsRequest {
                    page_size: page_size__.unwrap_or_default(),
                    page_token: page_token__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListActorsRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ListActorsResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.actors.is_empty() {
            len += 1;
        }
        if !self.next_page_token.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListActorsResponse", len)?;
        if !self.actors.is_empty() {
            struct_ser.serialize_field("actors", &self.actors)?;
        }
        if !self.next_page_token.is_empty() {
            struct_ser.serialize_field("nextPageToken", &self.next_page_token)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListActorsResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actors",
            "next_page_token",
            "nextPageToken",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actors,
            NextPageToken,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actors" => Ok(GeneratedField::Actors),
                            "nextPageToken" | "next_page_token" => Ok(GeneratedField::NextPageToken),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListActorsResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListActorsResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListActorsResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actors__ = None;
                let mut next_page_token__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actors => {
                            if actors__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actors"));
                            }
                            actors__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NextPageToken => {
                            if next_page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextPageToken"));
                            }
                            next_page_token__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListActorsResponse {
                    actors: actors__.unwrap_or_default(),
                    next_page_token: next_page_token__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListActorsResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ListSessionsRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.page_size != 0 {
            len += 1;
        }
        if !self.page_token.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListSessionsRequest", len)?;
        if self.page_size != 0 {
            struct_ser.serialize_field("pageSize", &self.page_size)?;
        }
        if !self.page_token.is_empty() {
            struct_ser.serialize_field("pageToken", &self.page_token)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListSessionsRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "page_size",
            "pageSize",
            "page_token",
            "pageToken",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            PageSize,
            PageToken,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "pageSize" | "page_size" => Ok(GeneratedField::PageSize),
                            "pageToken" | "page_token" => Ok(GeneratedField::PageToken),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListSessionsRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListSessionsRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListSessionsRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut page_size__ = None;
                let mut page_token__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::PageSize => {
                            if page_size__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageSize"));
                            }
                            page_size__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::PageToken => {
                            if page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageToken"));
                            }
                            page_token__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListSessionsRequest {
                    page_size: page_size__.unwrap_or_default(),
                    page_token: page_token__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListSessionsRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ListSessionsResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.sessions.is_empty() {
            len += 1;
        }
        if !self.next_page_token.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListSessionsResponse", len)?;
        if !self.sessions.is_empty() {
            struct_ser.serialize_field("sessions", &self.sessions)?;
        }
        if !self.next_page_token.is_empty() {
            struct_ser.serialize_field("nextPageToken", &self.next_page_token)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListSessionsResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "sessions",
            "next_page_token",
            "nextPageToken",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Sessions,
            NextPageToken,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "sessions" => Ok(GeneratedField::Sessions),
                            "nextPageToken" | "next_page_token" => Ok(GeneratedField::NextPageToken),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListSessionsResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListSessionsResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListSessionsResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut sessions__ = None;
                let mut next_page_token__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Sessions => {
                            if sessions__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sessions"));
                            }
                            sessions__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NextPageToken => {
                            if next_page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextPageToken"));
                            }
                            next_page_token__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListSessionsResponse {
                    sessions: sessions__.unwrap_or_default(),
                    next_page_token: next_page_token__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListSessionsResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ListTakesRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.page_size != 0 {
            len += 1;
        }
        if !self.page_token.is_empty() {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.slate.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListTakesRequest", len)?;
        if self.page_size != 0 {
            struct_ser.serialize_field("pageSize", &self.page_size)?;
        }
        if !self.page_token.is_empty() {
            struct_ser.serialize_field("pageToken", &self.page_token)?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.slate.is_empty() {
            struct_ser.serialize_field("slate", &self.slate)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListTakesRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "page_size",
            "pageSize",
            "page_token",
            "pageToken",
            "actor",
            "session",
            "slate",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            PageSize,
            PageToken,
            Actor,
            Session,
            Slate,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "pageSize" | "page_size" => Ok(GeneratedField::PageSize),
                            "pageToken" | "page_token" => Ok(GeneratedField::PageToken),
                            "actor" => Ok(GeneratedField::Actor),
                            "session" => Ok(GeneratedField::Session),
                            "slate" => Ok(GeneratedField::Slate),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListTakesRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListTakesRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListTakesRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut page_size__ = None;
                let mut page_token__ = None;
                let mut actor__ = None;
                let mut session__ = None;
                let mut slate__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::PageSize => {
                            if page_size__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageSize"));
                            }
                            page_size__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::PageToken => {
                            if page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("pageToken"));
                            }
                            page_token__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Slate => {
                            if slate__.is_some() {
                                return Err(serde::de::Error::duplicate_field("slate"));
                            }
                            slate__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListTakesRequest {
                    page_size: page_size__.unwrap_or_default(),
                    page_token: page_token__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    session: session__.unwrap_or_default(),
                    slate: slate__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListTakesRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ListTakesResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.takes.is_empty() {
            len += 1;
        }
        if !self.next_page_token.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ListTakesResponse", len)?;
        if !self.takes.is_empty() {
            struct_ser.serialize_field("takes", &self.takes)?;
        }
        if !self.next_page_token.is_empty() {
            struct_ser.serialize_field("nextPageToken", &self.next_page_token)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ListTakesResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "takes",
            "next_page_token",
            "nextPageToken",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Takes,
            NextPageToken,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "takes" => Ok(GeneratedField::Takes),
                            "nextPageToken" | "next_page_token" => Ok(GeneratedField::NextPageToken),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ListTakesResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ListTakesResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ListTakesResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut takes__ = None;
                let mut next_page_token__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Takes => {
                            if takes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("takes"));
                            }
                            takes__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NextPageToken => {
                            if next_page_token__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextPageToken"));
                            }
                            next_page_token__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ListTakesResponse {
                    takes: takes__.unwrap_or_default(),
                    next_page_token: next_page_token__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ListTakesResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Marker {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.region != 0 {
            len += 1;
        }
        if self.head_fixed {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Marker", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.region != 0 {
            let v = FaceRegion::try_from(self.region)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.region)))?;
            struct_ser.serialize_field("region", &v)?;
        }
        if self.head_fixed {
            struct_ser.serialize_field("headFixed", &self.head_fixed)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Marker {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "region",
            "head_fixed",
            "headFixed",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Region,
            HeadFixed,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "region" => Ok(GeneratedField::Region),
                            "headFixed" | "head_fixed" => Ok(GeneratedField::HeadFixed),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Marker;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Marker")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Marker, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut region__ = None;
                let mut head_fixed__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Region => {
                            if region__.is_some() {
                                return Err(serde::de::Error::duplicate_field("region"));
                            }
                            region__ = Some(map_.next_value::<FaceRegion>()? as i32);
                        }
                        GeneratedField::HeadFixed => {
                            if head_fixed__.is_some() {
                                return Err(serde::de::Error::duplicate_field("headFixed"));
                            }
                            head_fixed__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(Marker {
                    name: name__.unwrap_or_default(),
                    region: region__.unwrap_or_default(),
                    head_fixed: head_fixed__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Marker", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for MarkerFrame {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.number != 0 {
            len += 1;
        }
        if self.capture_time_nanos != 0 {
            len += 1;
        }
        if self.timecode.is_some() {
            len += 1;
        }
        if !self.positions.is_empty() {
            len += 1;
        }
        if self.source_frame != 0 {
            len += 1;
        }
        if self.crc32c.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.MarkerFrame", len)?;
        if self.number != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("number", ToString::to_string(&self.number).as_str())?;
        }
        if self.capture_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("captureTimeNanos", ToString::to_string(&self.capture_time_nanos).as_str())?;
        }
        if let Some(v) = self.timecode.as_ref() {
            struct_ser.serialize_field("timecode", v)?;
        }
        if !self.positions.is_empty() {
            struct_ser.serialize_field("positions", &self.positions)?;
        }
        if self.source_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("sourceFrame", ToString::to_string(&self.source_frame).as_str())?;
        }
        if let Some(v) = self.crc32c.as_ref() {
            struct_ser.serialize_field("crc32c", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for MarkerFrame {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "number",
            "capture_time_nanos",
            "captureTimeNanos",
            "timecode",
            "positions",
            "source_frame",
            "sourceFrame",
            "crc32c",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Number,
            CaptureTimeNanos,
            Timecode,
            Positions,
            SourceFrame,
            Crc32c,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "number" => Ok(GeneratedField::Number),
                            "captureTimeNanos" | "capture_time_nanos" => Ok(GeneratedField::CaptureTimeNanos),
                            "timecode" => Ok(GeneratedField::Timecode),
                            "positions" => Ok(GeneratedField::Positions),
                            "sourceFrame" | "source_frame" => Ok(GeneratedField::SourceFrame),
                            "crc32c" => Ok(GeneratedField::Crc32c),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = MarkerFrame;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.MarkerFrame")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<MarkerFrame, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut number__ = None;
                let mut capture_time_nanos__ = None;
                let mut timecode__ = None;
                let mut positions__ = None;
                let mut source_frame__ = None;
                let mut crc32c__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::CaptureTimeNanos => {
                            if capture_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("captureTimeNanos"));
                            }
                            capture_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Timecode => {
                            if timecode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("timecode"));
                            }
                            timecode__ = map_.next_value()?;
                        }
                        GeneratedField::Positions => {
                            if positions__.is_some() {
                                return Err(serde::de::Error::duplicate_field("positions"));
                            }
                            positions__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::SourceFrame => {
                            if source_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sourceFrame"));
                            }
                            source_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Crc32c => {
                            if crc32c__.is_some() {
                                return Err(serde::de::Error::duplicate_field("crc32c"));
                            }
                            crc32c__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                    }
                }
                Ok(MarkerFrame {
                    number: number__.unwrap_or_default(),
                    capture_time_nanos: capture_time_nanos__.unwrap_or_default(),
                    timecode: timecode__,
                    positions: positions__.unwrap_or_default(),
                    source_frame: source_frame__.unwrap_or_default(),
                    crc32c: crc32c__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.MarkerFrame", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Muscle {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.region != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Muscle", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.region != 0 {
            let v = FaceRegion::try_from(self.region)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.region)))?;
            struct_ser.serialize_field("region", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Muscle {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "region",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Region,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "region" => Ok(GeneratedField::Region),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Muscle;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Muscle")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Muscle, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut region__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Region => {
                            if region__.is_some() {
                                return Err(serde::de::Error::duplicate_field("region"));
                            }
                            region__ = Some(map_.next_value::<FaceRegion>()? as i32);
                        }
                    }
                }
                Ok(Muscle {
                    name: name__.unwrap_or_default(),
                    region: region__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Muscle", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for MusclePair {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.first.is_empty() {
            len += 1;
        }
        if !self.second.is_empty() {
            len += 1;
        }
        if self.correlation != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.MusclePair", len)?;
        if !self.first.is_empty() {
            struct_ser.serialize_field("first", &self.first)?;
        }
        if !self.second.is_empty() {
            struct_ser.serialize_field("second", &self.second)?;
        }
        if self.correlation != 0. {
            struct_ser.serialize_field("correlation", &self.correlation)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for MusclePair {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "first",
            "second",
            "correlation",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            First,
            Second,
            Correlation,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "first" => Ok(GeneratedField::First),
                            "second" => Ok(GeneratedField::Second),
                            "correlation" => Ok(GeneratedField::Correlation),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = MusclePair;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.MusclePair")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<MusclePair, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut first__ = None;
                let mut second__ = None;
                let mut correlation__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::First => {
                            if first__.is_some() {
                                return Err(serde::de::Error::duplicate_field("first"));
                            }
                            first__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Second => {
                            if second__.is_some() {
                                return Err(serde::de::Error::duplicate_field("second"));
                            }
                            second__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Correlation => {
                            if correlation__.is_some() {
                                return Err(serde::de::Error::duplicate_field("correlation"));
                            }
                            correlation__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(MusclePair {
                    first: first__.unwrap_or_default(),
                    second: second__.unwrap_or_default(),
                    correlation: correlation__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.MusclePair", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for NeutralDoubt {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.cause != 0 {
            len += 1;
        }
        if self.residual_cm != 0. {
            len += 1;
        }
        if self.expected_cm != 0. {
            len += 1;
        }
        if !self.advice.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.NeutralDoubt", len)?;
        if self.cause != 0 {
            let v = NeutralDoubtCause::try_from(self.cause)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.cause)))?;
            struct_ser.serialize_field("cause", &v)?;
        }
        if self.residual_cm != 0. {
            struct_ser.serialize_field("residualCm", &self.residual_cm)?;
        }
        if self.expected_cm != 0. {
            struct_ser.serialize_field("expectedCm", &self.expected_cm)?;
        }
        if !self.advice.is_empty() {
            struct_ser.serialize_field("advice", &self.advice)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for NeutralDoubt {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "cause",
            "residual_cm",
            "residualCm",
            "expected_cm",
            "expectedCm",
            "advice",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Cause,
            ResidualCm,
            ExpectedCm,
            Advice,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "cause" => Ok(GeneratedField::Cause),
                            "residualCm" | "residual_cm" => Ok(GeneratedField::ResidualCm),
                            "expectedCm" | "expected_cm" => Ok(GeneratedField::ExpectedCm),
                            "advice" => Ok(GeneratedField::Advice),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = NeutralDoubt;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.NeutralDoubt")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<NeutralDoubt, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut cause__ = None;
                let mut residual_cm__ = None;
                let mut expected_cm__ = None;
                let mut advice__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Cause => {
                            if cause__.is_some() {
                                return Err(serde::de::Error::duplicate_field("cause"));
                            }
                            cause__ = Some(map_.next_value::<NeutralDoubtCause>()? as i32);
                        }
                        GeneratedField::ResidualCm => {
                            if residual_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("residualCm"));
                            }
                            residual_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ExpectedCm => {
                            if expected_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("expectedCm"));
                            }
                            expected_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Advice => {
                            if advice__.is_some() {
                                return Err(serde::de::Error::duplicate_field("advice"));
                            }
                            advice__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(NeutralDoubt {
                    cause: cause__.unwrap_or_default(),
                    residual_cm: residual_cm__.unwrap_or_default(),
                    expected_cm: expected_cm__.unwrap_or_default(),
                    advice: advice__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.NeutralDoubt", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for NeutralDoubtCause {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "NEUTRAL_DOUBT_CAUSE_UNSPECIFIED",
            Self::LooksContracted => "NEUTRAL_DOUBT_CAUSE_LOOKS_CONTRACTED",
            Self::QuieterFramesSeen => "NEUTRAL_DOUBT_CAUSE_QUIETER_FRAMES_SEEN",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for NeutralDoubtCause {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "NEUTRAL_DOUBT_CAUSE_UNSPECIFIED",
            "NEUTRAL_DOUBT_CAUSE_LOOKS_CONTRACTED",
            "NEUTRAL_DOUBT_CAUSE_QUIETER_FRAMES_SEEN",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = NeutralDoubtCause;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "NEUTRAL_DOUBT_CAUSE_UNSPECIFIED" => Ok(NeutralDoubtCause::Unspecified),
                    "NEUTRAL_DOUBT_CAUSE_LOOKS_CONTRACTED" => Ok(NeutralDoubtCause::LooksContracted),
                    "NEUTRAL_DOUBT_CAUSE_QUIETER_FRAMES_SEEN" => Ok(NeutralDoubtCause::QuieterFramesSeen),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for NeutralSource {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "NEUTRAL_SOURCE_UNSPECIFIED",
            Self::NextFrames => "NEUTRAL_SOURCE_NEXT_FRAMES",
            Self::QuietestFrames => "NEUTRAL_SOURCE_QUIETEST_FRAMES",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for NeutralSource {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "NEUTRAL_SOURCE_UNSPECIFIED",
            "NEUTRAL_SOURCE_NEXT_FRAMES",
            "NEUTRAL_SOURCE_QUIETEST_FRAMES",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = NeutralSource;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "NEUTRAL_SOURCE_UNSPECIFIED" => Ok(NeutralSource::Unspecified),
                    "NEUTRAL_SOURCE_NEXT_FRAMES" => Ok(NeutralSource::NextFrames),
                    "NEUTRAL_SOURCE_QUIETEST_FRAMES" => Ok(NeutralSource::QuietestFrames),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for Percentiles {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.p1 != 0. {
            len += 1;
        }
        if self.p99 != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Percentiles", len)?;
        if self.p1 != 0. {
            struct_ser.serialize_field("p1", &self.p1)?;
        }
        if self.p99 != 0. {
            struct_ser.serialize_field("p99", &self.p99)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Percentiles {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "p1",
            "p99",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            P1,
            P99,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "p1" => Ok(GeneratedField::P1),
                            "p99" => Ok(GeneratedField::P99),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Percentiles;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Percentiles")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Percentiles, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut p1__ = None;
                let mut p99__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::P1 => {
                            if p1__.is_some() {
                                return Err(serde::de::Error::duplicate_field("p1"));
                            }
                            p1__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::P99 => {
                            if p99__.is_some() {
                                return Err(serde::de::Error::duplicate_field("p99"));
                            }
                            p99__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(Percentiles {
                    p1: p1__.unwrap_or_default(),
                    p99: p99__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Percentiles", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Principal {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.role != 0 {
            len += 1;
        }
        if !self.sessions.is_empty() {
            len += 1;
        }
        if self.expire_time.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Principal", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.role != 0 {
            let v = Role::try_from(self.role)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.role)))?;
            struct_ser.serialize_field("role", &v)?;
        }
        if !self.sessions.is_empty() {
            struct_ser.serialize_field("sessions", &self.sessions)?;
        }
        if let Some(v) = self.expire_time.as_ref() {
            struct_ser.serialize_field("expireTime", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Principal {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "role",
            "sessions",
            "expire_time",
            "expireTime",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Role,
            Sessions,
            ExpireTime,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "role" => Ok(GeneratedField::Role),
                            "sessions" => Ok(GeneratedField::Sessions),
                            "expireTime" | "expire_time" => Ok(GeneratedField::ExpireTime),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Principal;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Principal")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Principal, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut role__ = None;
                let mut sessions__ = None;
                let mut expire_time__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Role => {
                            if role__.is_some() {
                                return Err(serde::de::Error::duplicate_field("role"));
                            }
                            role__ = Some(map_.next_value::<Role>()? as i32);
                        }
                        GeneratedField::Sessions => {
                            if sessions__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sessions"));
                            }
                            sessions__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ExpireTime => {
                            if expire_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("expireTime"));
                            }
                            expire_time__ = map_.next_value()?;
                        }
                    }
                }
                Ok(Principal {
                    name: name__.unwrap_or_default(),
                    role: role__.unwrap_or_default(),
                    sessions: sessions__.unwrap_or_default(),
                    expire_time: expire_time__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Principal", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for PublishImagesRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.start.is_some() {
            len += 1;
        }
        if !self.frames.is_empty() {
            len += 1;
        }
        if self.clock.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.PublishImagesRequest", len)?;
        if let Some(v) = self.start.as_ref() {
            struct_ser.serialize_field("start", v)?;
        }
        if !self.frames.is_empty() {
            struct_ser.serialize_field("frames", &self.frames)?;
        }
        if let Some(v) = self.clock.as_ref() {
            struct_ser.serialize_field("clock", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for PublishImagesRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "start",
            "frames",
            "clock",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Start,
            Frames,
            Clock,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "start" => Ok(GeneratedField::Start),
                            "frames" => Ok(GeneratedField::Frames),
                            "clock" => Ok(GeneratedField::Clock),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = PublishImagesRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.PublishImagesRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<PublishImagesRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut start__ = None;
                let mut frames__ = None;
                let mut clock__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Start => {
                            if start__.is_some() {
                                return Err(serde::de::Error::duplicate_field("start"));
                            }
                            start__ = map_.next_value()?;
                        }
                        GeneratedField::Frames => {
                            if frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("frames"));
                            }
                            frames__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Clock => {
                            if clock__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clock"));
                            }
                            clock__ = map_.next_value()?;
                        }
                    }
                }
                Ok(PublishImagesRequest {
                    start: start__,
                    frames: frames__.unwrap_or_default(),
                    clock: clock__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.PublishImagesRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for PublishMarkersRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.start.is_some() {
            len += 1;
        }
        if !self.frames.is_empty() {
            len += 1;
        }
        if self.clock.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.PublishMarkersRequest", len)?;
        if let Some(v) = self.start.as_ref() {
            struct_ser.serialize_field("start", v)?;
        }
        if !self.frames.is_empty() {
            struct_ser.serialize_field("frames", &self.frames)?;
        }
        if let Some(v) = self.clock.as_ref() {
            struct_ser.serialize_field("clock", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for PublishMarkersRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "start",
            "frames",
            "clock",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Start,
            Frames,
            Clock,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "start" => Ok(GeneratedField::Start),
                            "frames" => Ok(GeneratedField::Frames),
                            "clock" => Ok(GeneratedField::Clock),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = PublishMarkersRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.PublishMarkersRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<PublishMarkersRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut start__ = None;
                let mut frames__ = None;
                let mut clock__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Start => {
                            if start__.is_some() {
                                return Err(serde::de::Error::duplicate_field("start"));
                            }
                            start__ = map_.next_value()?;
                        }
                        GeneratedField::Frames => {
                            if frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("frames"));
                            }
                            frames__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Clock => {
                            if clock__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clock"));
                            }
                            clock__ = map_.next_value()?;
                        }
                    }
                }
                Ok(PublishMarkersRequest {
                    start: start__,
                    frames: frames__.unwrap_or_default(),
                    clock: clock__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.PublishMarkersRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for PublishResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.started.is_some() {
            len += 1;
        }
        if self.accepted_through != 0 {
            len += 1;
        }
        if self.durable_through != 0 {
            len += 1;
        }
        if !self.rejected.is_empty() {
            len += 1;
        }
        if self.shed_frames != 0 {
            len += 1;
        }
        if self.server_send_nanos != 0 {
            len += 1;
        }
        if self.recording {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.PublishResponse", len)?;
        if let Some(v) = self.started.as_ref() {
            struct_ser.serialize_field("started", v)?;
        }
        if self.accepted_through != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("acceptedThrough", ToString::to_string(&self.accepted_through).as_str())?;
        }
        if self.durable_through != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("durableThrough", ToString::to_string(&self.durable_through).as_str())?;
        }
        if !self.rejected.is_empty() {
            struct_ser.serialize_field("rejected", &self.rejected)?;
        }
        if self.shed_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("shedFrames", ToString::to_string(&self.shed_frames).as_str())?;
        }
        if self.server_send_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("serverSendNanos", ToString::to_string(&self.server_send_nanos).as_str())?;
        }
        if self.recording {
            struct_ser.serialize_field("recording", &self.recording)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for PublishResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "started",
            "accepted_through",
            "acceptedThrough",
            "durable_through",
            "durableThrough",
            "rejected",
            "shed_frames",
            "shedFrames",
            "server_send_nanos",
            "serverSendNanos",
            "recording",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Started,
            AcceptedThrough,
            DurableThrough,
            Rejected,
            ShedFrames,
            ServerSendNanos,
            Recording,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "started" => Ok(GeneratedField::Started),
                            "acceptedThrough" | "accepted_through" => Ok(GeneratedField::AcceptedThrough),
                            "durableThrough" | "durable_through" => Ok(GeneratedField::DurableThrough),
                            "rejected" => Ok(GeneratedField::Rejected),
                            "shedFrames" | "shed_frames" => Ok(GeneratedField::ShedFrames),
                            "serverSendNanos" | "server_send_nanos" => Ok(GeneratedField::ServerSendNanos),
                            "recording" => Ok(GeneratedField::Recording),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = PublishResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.PublishResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<PublishResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut started__ = None;
                let mut accepted_through__ = None;
                let mut durable_through__ = None;
                let mut rejected__ = None;
                let mut shed_frames__ = None;
                let mut server_send_nanos__ = None;
                let mut recording__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Started => {
                            if started__.is_some() {
                                return Err(serde::de::Error::duplicate_field("started"));
                            }
                            started__ = map_.next_value()?;
                        }
                        GeneratedField::AcceptedThrough => {
                            if accepted_through__.is_some() {
                                return Err(serde::de::Error::duplicate_field("acceptedThrough"));
                            }
                            accepted_through__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::DurableThrough => {
                            if durable_through__.is_some() {
                                return Err(serde::de::Error::duplicate_field("durableThrough"));
                            }
                            durable_through__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Rejected => {
                            if rejected__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rejected"));
                            }
                            rejected__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ShedFrames => {
                            if shed_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("shedFrames"));
                            }
                            shed_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ServerSendNanos => {
                            if server_send_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("serverSendNanos"));
                            }
                            server_send_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Recording => {
                            if recording__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recording"));
                            }
                            recording__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(PublishResponse {
                    started: started__,
                    accepted_through: accepted_through__.unwrap_or_default(),
                    durable_through: durable_through__.unwrap_or_default(),
                    rejected: rejected__.unwrap_or_default(),
                    shed_frames: shed_frames__.unwrap_or_default(),
                    server_send_nanos: server_send_nanos__.unwrap_or_default(),
                    recording: recording__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.PublishResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for PublishStart {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.publisher.is_empty() {
            len += 1;
        }
        if !self.marker_names.is_empty() {
            len += 1;
        }
        if self.unit != 0 {
            len += 1;
        }
        if self.takeover {
            len += 1;
        }
        if self.ingest != 0 {
            len += 1;
        }
        if self.image.is_some() {
            len += 1;
        }
        if self.rate_hz != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.PublishStart", len)?;
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.publisher.is_empty() {
            struct_ser.serialize_field("publisher", &self.publisher)?;
        }
        if !self.marker_names.is_empty() {
            struct_ser.serialize_field("markerNames", &self.marker_names)?;
        }
        if self.unit != 0 {
            let v = LengthUnit::try_from(self.unit)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.unit)))?;
            struct_ser.serialize_field("unit", &v)?;
        }
        if self.takeover {
            struct_ser.serialize_field("takeover", &self.takeover)?;
        }
        if self.ingest != 0 {
            let v = Ingest::try_from(self.ingest)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.ingest)))?;
            struct_ser.serialize_field("ingest", &v)?;
        }
        if let Some(v) = self.image.as_ref() {
            struct_ser.serialize_field("image", v)?;
        }
        if self.rate_hz != 0. {
            struct_ser.serialize_field("rateHz", &self.rate_hz)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for PublishStart {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
            "publisher",
            "marker_names",
            "markerNames",
            "unit",
            "takeover",
            "ingest",
            "image",
            "rate_hz",
            "rateHz",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
            Publisher,
            MarkerNames,
            Unit,
            Takeover,
            Ingest,
            Image,
            RateHz,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            "publisher" => Ok(GeneratedField::Publisher),
                            "markerNames" | "marker_names" => Ok(GeneratedField::MarkerNames),
                            "unit" => Ok(GeneratedField::Unit),
                            "takeover" => Ok(GeneratedField::Takeover),
                            "ingest" => Ok(GeneratedField::Ingest),
                            "image" => Ok(GeneratedField::Image),
                            "rateHz" | "rate_hz" => Ok(GeneratedField::RateHz),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = PublishStart;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.PublishStart")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<PublishStart, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                let mut publisher__ = None;
                let mut marker_names__ = None;
                let mut unit__ = None;
                let mut takeover__ = None;
                let mut ingest__ = None;
                let mut image__ = None;
                let mut rate_hz__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Publisher => {
                            if publisher__.is_some() {
                                return Err(serde::de::Error::duplicate_field("publisher"));
                            }
                            publisher__ = Some(map_.next_value()?);
                        }
                        GeneratedField::MarkerNames => {
                            if marker_names__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markerNames"));
                            }
                            marker_names__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Unit => {
                            if unit__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unit"));
                            }
                            unit__ = Some(map_.next_value::<LengthUnit>()? as i32);
                        }
                        GeneratedField::Takeover => {
                            if takeover__.is_some() {
                                return Err(serde::de::Error::duplicate_field("takeover"));
                            }
                            takeover__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Ingest => {
                            if ingest__.is_some() {
                                return Err(serde::de::Error::duplicate_field("ingest"));
                            }
                            ingest__ = Some(map_.next_value::<Ingest>()? as i32);
                        }
                        GeneratedField::Image => {
                            if image__.is_some() {
                                return Err(serde::de::Error::duplicate_field("image"));
                            }
                            image__ = map_.next_value()?;
                        }
                        GeneratedField::RateHz => {
                            if rate_hz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rateHz"));
                            }
                            rate_hz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(PublishStart {
                    session: session__.unwrap_or_default(),
                    publisher: publisher__.unwrap_or_default(),
                    marker_names: marker_names__.unwrap_or_default(),
                    unit: unit__.unwrap_or_default(),
                    takeover: takeover__.unwrap_or_default(),
                    ingest: ingest__.unwrap_or_default(),
                    image: image__,
                    rate_hz: rate_hz__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.PublishStart", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for PublishStarted {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.epoch != 0 {
            len += 1;
        }
        if self.next_expected != 0 {
            len += 1;
        }
        if self.durable_through != 0 {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if self.recorded_run != 0 {
            len += 1;
        }
        if self.recorded_through != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.PublishStarted", len)?;
        if self.epoch != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("epoch", ToString::to_string(&self.epoch).as_str())?;
        }
        if self.next_expected != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nextExpected", ToString::to_string(&self.next_expected).as_str())?;
        }
        if self.durable_through != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("durableThrough", ToString::to_string(&self.durable_through).as_str())?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if self.recorded_run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("recordedRun", ToString::to_string(&self.recorded_run).as_str())?;
        }
        if self.recorded_through != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("recordedThrough", ToString::to_string(&self.recorded_through).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for PublishStarted {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "epoch",
            "next_expected",
            "nextExpected",
            "durable_through",
            "durableThrough",
            "run",
            "recorded_run",
            "recordedRun",
            "recorded_through",
            "recordedThrough",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Epoch,
            NextExpected,
            DurableThrough,
            Run,
            RecordedRun,
            RecordedThrough,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "epoch" => Ok(GeneratedField::Epoch),
                            "nextExpected" | "next_expected" => Ok(GeneratedField::NextExpected),
                            "durableThrough" | "durable_through" => Ok(GeneratedField::DurableThrough),
                            "run" => Ok(GeneratedField::Run),
                            "recordedRun" | "recorded_run" => Ok(GeneratedField::RecordedRun),
                            "recordedThrough" | "recorded_through" => Ok(GeneratedField::RecordedThrough),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = PublishStarted;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.PublishStarted")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<PublishStarted, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut epoch__ = None;
                let mut next_expected__ = None;
                let mut durable_through__ = None;
                let mut run__ = None;
                let mut recorded_run__ = None;
                let mut recorded_through__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Epoch => {
                            if epoch__.is_some() {
                                return Err(serde::de::Error::duplicate_field("epoch"));
                            }
                            epoch__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NextExpected => {
                            if next_expected__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextExpected"));
                            }
                            next_expected__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::DurableThrough => {
                            if durable_through__.is_some() {
                                return Err(serde::de::Error::duplicate_field("durableThrough"));
                            }
                            durable_through__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RecordedRun => {
                            if recorded_run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recordedRun"));
                            }
                            recorded_run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RecordedThrough => {
                            if recorded_through__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recordedThrough"));
                            }
                            recorded_through__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(PublishStarted {
                    epoch: epoch__.unwrap_or_default(),
                    next_expected: next_expected__.unwrap_or_default(),
                    durable_through: durable_through__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    recorded_run: recorded_run__.unwrap_or_default(),
                    recorded_through: recorded_through__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.PublishStarted", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Quality {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "QUALITY_UNSPECIFIED",
            Self::Solved => "QUALITY_SOLVED",
            Self::Partial => "QUALITY_PARTIAL",
            Self::Held => "QUALITY_HELD",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for Quality {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "QUALITY_UNSPECIFIED",
            "QUALITY_SOLVED",
            "QUALITY_PARTIAL",
            "QUALITY_HELD",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = Quality;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "QUALITY_UNSPECIFIED" => Ok(Quality::Unspecified),
                    "QUALITY_SOLVED" => Ok(Quality::Solved),
                    "QUALITY_PARTIAL" => Ok(Quality::Partial),
                    "QUALITY_HELD" => Ok(Quality::Held),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for RangeVerdict {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "RANGE_VERDICT_UNSPECIFIED",
            Self::NotYetSeen => "RANGE_VERDICT_NOT_YET_SEEN",
            Self::Sound => "RANGE_VERDICT_SOUND",
            Self::TooWeak => "RANGE_VERDICT_TOO_WEAK",
            Self::TooStrong => "RANGE_VERDICT_TOO_STRONG",
            Self::WrongDirection => "RANGE_VERDICT_WRONG_DIRECTION",
            Self::HardlyObservable => "RANGE_VERDICT_HARDLY_OBSERVABLE",
            Self::NeutralInDoubt => "RANGE_VERDICT_NEUTRAL_IN_DOUBT",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for RangeVerdict {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "RANGE_VERDICT_UNSPECIFIED",
            "RANGE_VERDICT_NOT_YET_SEEN",
            "RANGE_VERDICT_SOUND",
            "RANGE_VERDICT_TOO_WEAK",
            "RANGE_VERDICT_TOO_STRONG",
            "RANGE_VERDICT_WRONG_DIRECTION",
            "RANGE_VERDICT_HARDLY_OBSERVABLE",
            "RANGE_VERDICT_NEUTRAL_IN_DOUBT",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = RangeVerdict;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "RANGE_VERDICT_UNSPECIFIED" => Ok(RangeVerdict::Unspecified),
                    "RANGE_VERDICT_NOT_YET_SEEN" => Ok(RangeVerdict::NotYetSeen),
                    "RANGE_VERDICT_SOUND" => Ok(RangeVerdict::Sound),
                    "RANGE_VERDICT_TOO_WEAK" => Ok(RangeVerdict::TooWeak),
                    "RANGE_VERDICT_TOO_STRONG" => Ok(RangeVerdict::TooStrong),
                    "RANGE_VERDICT_WRONG_DIRECTION" => Ok(RangeVerdict::WrongDirection),
                    "RANGE_VERDICT_HARDLY_OBSERVABLE" => Ok(RangeVerdict::HardlyObservable),
                    "RANGE_VERDICT_NEUTRAL_IN_DOUBT" => Ok(RangeVerdict::NeutralInDoubt),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for ReadCurvesRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session.is_empty() {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if self.after.is_some() {
            len += 1;
        }
        if self.limit != 0 {
            len += 1;
        }
        if self.with_uncertainty {
            len += 1;
        }
        if self.with_markers {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ReadCurvesRequest", len)?;
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if let Some(v) = self.after.as_ref() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("after", ToString::to_string(&v).as_str())?;
        }
        if self.limit != 0 {
            struct_ser.serialize_field("limit", &self.limit)?;
        }
        if self.with_uncertainty {
            struct_ser.serialize_field("withUncertainty", &self.with_uncertainty)?;
        }
        if self.with_markers {
            struct_ser.serialize_field("withMarkers", &self.with_markers)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ReadCurvesRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
            "run",
            "after",
            "limit",
            "with_uncertainty",
            "withUncertainty",
            "with_markers",
            "withMarkers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
            Run,
            After,
            Limit,
            WithUncertainty,
            WithMarkers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            "run" => Ok(GeneratedField::Run),
                            "after" => Ok(GeneratedField::After),
                            "limit" => Ok(GeneratedField::Limit),
                            "withUncertainty" | "with_uncertainty" => Ok(GeneratedField::WithUncertainty),
                            "withMarkers" | "with_markers" => Ok(GeneratedField::WithMarkers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ReadCurvesRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ReadCurvesRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ReadCurvesRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                let mut run__ = None;
                let mut after__ = None;
                let mut limit__ = None;
                let mut with_uncertainty__ = None;
                let mut with_markers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::After => {
                            if after__.is_some() {
                                return Err(serde::de::Error::duplicate_field("after"));
                            }
                            after__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::Limit => {
                            if limit__.is_some() {
                                return Err(serde::de::Error::duplicate_field("limit"));
                            }
                            limit__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::WithUncertainty => {
                            if with_uncertainty__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withUncertainty"));
                            }
                            with_uncertainty__ = Some(map_.next_value()?);
                        }
                        GeneratedField::WithMarkers => {
                            if with_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withMarkers"));
                            }
                            with_markers__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(ReadCurvesRequest {
                    session: session__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    after: after__,
                    limit: limit__.unwrap_or_default(),
                    with_uncertainty: with_uncertainty__.unwrap_or_default(),
                    with_markers: with_markers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ReadCurvesRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ReadCurvesResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.header.is_some() {
            len += 1;
        }
        if !self.samples.is_empty() {
            len += 1;
        }
        if !self.gaps.is_empty() {
            len += 1;
        }
        if self.read_through != 0 {
            len += 1;
        }
        if self.newest_sequence != 0 {
            len += 1;
        }
        if self.state.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ReadCurvesResponse", len)?;
        if let Some(v) = self.header.as_ref() {
            struct_ser.serialize_field("header", v)?;
        }
        if !self.samples.is_empty() {
            struct_ser.serialize_field("samples", &self.samples)?;
        }
        if !self.gaps.is_empty() {
            struct_ser.serialize_field("gaps", &self.gaps)?;
        }
        if self.read_through != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("readThrough", ToString::to_string(&self.read_through).as_str())?;
        }
        if self.newest_sequence != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("newestSequence", ToString::to_string(&self.newest_sequence).as_str())?;
        }
        if let Some(v) = self.state.as_ref() {
            struct_ser.serialize_field("state", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ReadCurvesResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "header",
            "samples",
            "gaps",
            "read_through",
            "readThrough",
            "newest_sequence",
            "newestSequence",
            "state",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Header,
            Samples,
            Gaps,
            ReadThrough,
            NewestSequence,
            State,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "header" => Ok(GeneratedField::Header),
                            "samples" => Ok(GeneratedField::Samples),
                            "gaps" => Ok(GeneratedField::Gaps),
                            "readThrough" | "read_through" => Ok(GeneratedField::ReadThrough),
                            "newestSequence" | "newest_sequence" => Ok(GeneratedField::NewestSequence),
                            "state" => Ok(GeneratedField::State),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ReadCurvesResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ReadCurvesResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ReadCurvesResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut header__ = None;
                let mut samples__ = None;
                let mut gaps__ = None;
                let mut read_through__ = None;
                let mut newest_sequence__ = None;
                let mut state__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Header => {
                            if header__.is_some() {
                                return Err(serde::de::Error::duplicate_field("header"));
                            }
                            header__ = map_.next_value()?;
                        }
                        GeneratedField::Samples => {
                            if samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("samples"));
                            }
                            samples__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Gaps => {
                            if gaps__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gaps"));
                            }
                            gaps__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ReadThrough => {
                            if read_through__.is_some() {
                                return Err(serde::de::Error::duplicate_field("readThrough"));
                            }
                            read_through__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NewestSequence => {
                            if newest_sequence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("newestSequence"));
                            }
                            newest_sequence__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::State => {
                            if state__.is_some() {
                                return Err(serde::de::Error::duplicate_field("state"));
                            }
                            state__ = map_.next_value()?;
                        }
                    }
                }
                Ok(ReadCurvesResponse {
                    header: header__,
                    samples: samples__.unwrap_or_default(),
                    gaps: gaps__.unwrap_or_default(),
                    read_through: read_through__.unwrap_or_default(),
                    newest_sequence: newest_sequence__.unwrap_or_default(),
                    state: state__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ReadCurvesResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for RecenterSessionRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.source != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.RecenterSessionRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.source != 0 {
            let v = NeutralSource::try_from(self.source)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.source)))?;
            struct_ser.serialize_field("source", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for RecenterSessionRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "source",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Source,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "source" => Ok(GeneratedField::Source),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = RecenterSessionRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.RecenterSessionRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<RecenterSessionRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut source__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Source => {
                            if source__.is_some() {
                                return Err(serde::de::Error::duplicate_field("source"));
                            }
                            source__ = Some(map_.next_value::<NeutralSource>()? as i32);
                        }
                    }
                }
                Ok(RecenterSessionRequest {
                    name: name__.unwrap_or_default(),
                    source: source__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.RecenterSessionRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for RecenterSessionResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.RecenterSessionResponse", len)?;
        if let Some(v) = self.session.as_ref() {
            struct_ser.serialize_field("session", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for RecenterSessionResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = RecenterSessionResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.RecenterSessionResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<RecenterSessionResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = map_.next_value()?;
                        }
                    }
                }
                Ok(RecenterSessionResponse {
                    session: session__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.RecenterSessionResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for RegionError {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.region != 0 {
            len += 1;
        }
        if self.marker_error_cm != 0. {
            len += 1;
        }
        if self.n_markers != 0 {
            len += 1;
        }
        if self.quality != 0 {
            len += 1;
        }
        if !self.held_reason.is_empty() {
            len += 1;
        }
        if self.quality_fraction != 0. {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.RegionError", len)?;
        if self.region != 0 {
            let v = FaceRegion::try_from(self.region)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.region)))?;
            struct_ser.serialize_field("region", &v)?;
        }
        if self.marker_error_cm != 0. {
            struct_ser.serialize_field("markerErrorCm", &self.marker_error_cm)?;
        }
        if self.n_markers != 0 {
            struct_ser.serialize_field("nMarkers", &self.n_markers)?;
        }
        if self.quality != 0 {
            let v = Quality::try_from(self.quality)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.quality)))?;
            struct_ser.serialize_field("quality", &v)?;
        }
        if !self.held_reason.is_empty() {
            struct_ser.serialize_field("heldReason", &self.held_reason)?;
        }
        if self.quality_fraction != 0. {
            struct_ser.serialize_field("qualityFraction", &self.quality_fraction)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for RegionError {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "region",
            "marker_error_cm",
            "markerErrorCm",
            "n_markers",
            "nMarkers",
            "quality",
            "held_reason",
            "heldReason",
            "quality_fraction",
            "qualityFraction",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Region,
            MarkerErrorCm,
            NMarkers,
            Quality,
            HeldReason,
            QualityFraction,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "region" => Ok(GeneratedField::Region),
                            "markerErrorCm" | "marker_error_cm" => Ok(GeneratedField::MarkerErrorCm),
                            "nMarkers" | "n_markers" => Ok(GeneratedField::NMarkers),
                            "quality" => Ok(GeneratedField::Quality),
                            "heldReason" | "held_reason" => Ok(GeneratedField::HeldReason),
                            "qualityFraction" | "quality_fraction" => Ok(GeneratedField::QualityFraction),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = RegionError;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.RegionError")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<RegionError, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut region__ = None;
                let mut marker_error_cm__ = None;
                let mut n_markers__ = None;
                let mut quality__ = None;
                let mut held_reason__ = None;
                let mut quality_fraction__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Region => {
                            if region__.is_some() {
                                return Err(serde::de::Error::duplicate_field("region"));
                            }
                            region__ = Some(map_.next_value::<FaceRegion>()? as i32);
                        }
                        GeneratedField::MarkerErrorCm => {
                            if marker_error_cm__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markerErrorCm"));
                            }
                            marker_error_cm__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NMarkers => {
                            if n_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nMarkers"));
                            }
                            n_markers__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Quality => {
                            if quality__.is_some() {
                                return Err(serde::de::Error::duplicate_field("quality"));
                            }
                            quality__ = Some(map_.next_value::<Quality>()? as i32);
                        }
                        GeneratedField::HeldReason => {
                            if held_reason__.is_some() {
                                return Err(serde::de::Error::duplicate_field("heldReason"));
                            }
                            held_reason__ = Some(map_.next_value()?);
                        }
                        GeneratedField::QualityFraction => {
                            if quality_fraction__.is_some() {
                                return Err(serde::de::Error::duplicate_field("qualityFraction"));
                            }
                            quality_fraction__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(RegionError {
                    region: region__.unwrap_or_default(),
                    marker_error_cm: marker_error_cm__.unwrap_or_default(),
                    n_markers: n_markers__.unwrap_or_default(),
                    quality: quality__.unwrap_or_default(),
                    held_reason: held_reason__.unwrap_or_default(),
                    quality_fraction: quality_fraction__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.RegionError", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for RegionMode {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "REGION_MODE_UNSPECIFIED",
            Self::Joint => "REGION_MODE_JOINT",
            Self::Split => "REGION_MODE_SPLIT",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for RegionMode {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "REGION_MODE_UNSPECIFIED",
            "REGION_MODE_JOINT",
            "REGION_MODE_SPLIT",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = RegionMode;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "REGION_MODE_UNSPECIFIED" => Ok(RegionMode::Unspecified),
                    "REGION_MODE_JOINT" => Ok(RegionMode::Joint),
                    "REGION_MODE_SPLIT" => Ok(RegionMode::Split),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for RejectedFrame {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.number != 0 {
            len += 1;
        }
        if !self.reason.is_empty() {
            len += 1;
        }
        if !self.detail.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.RejectedFrame", len)?;
        if self.number != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("number", ToString::to_string(&self.number).as_str())?;
        }
        if !self.reason.is_empty() {
            struct_ser.serialize_field("reason", &self.reason)?;
        }
        if !self.detail.is_empty() {
            struct_ser.serialize_field("detail", &self.detail)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for RejectedFrame {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "number",
            "reason",
            "detail",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Number,
            Reason,
            Detail,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "number" => Ok(GeneratedField::Number),
                            "reason" => Ok(GeneratedField::Reason),
                            "detail" => Ok(GeneratedField::Detail),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = RejectedFrame;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.RejectedFrame")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<RejectedFrame, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut number__ = None;
                let mut reason__ = None;
                let mut detail__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Reason => {
                            if reason__.is_some() {
                                return Err(serde::de::Error::duplicate_field("reason"));
                            }
                            reason__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Detail => {
                            if detail__.is_some() {
                                return Err(serde::de::Error::duplicate_field("detail"));
                            }
                            detail__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(RejectedFrame {
                    number: number__.unwrap_or_default(),
                    reason: reason__.unwrap_or_default(),
                    detail: detail__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.RejectedFrame", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ResolveTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ResolveTakeRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ResolveTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "actor_revision",
            "actorRevision",
            "settings",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            ActorRevision,
            Settings,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "settings" => Ok(GeneratedField::Settings),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ResolveTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ResolveTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ResolveTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut actor_revision__ = None;
                let mut settings__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                    }
                }
                Ok(ResolveTakeRequest {
                    name: name__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    settings: settings__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ResolveTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for ResolveTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.frames_done != 0 {
            len += 1;
        }
        if self.n_frames != 0 {
            len += 1;
        }
        if self.take.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.ResolveTakeResponse", len)?;
        if self.frames_done != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesDone", ToString::to_string(&self.frames_done).as_str())?;
        }
        if self.n_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nFrames", ToString::to_string(&self.n_frames).as_str())?;
        }
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for ResolveTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "frames_done",
            "framesDone",
            "n_frames",
            "nFrames",
            "take",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            FramesDone,
            NFrames,
            Take,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "framesDone" | "frames_done" => Ok(GeneratedField::FramesDone),
                            "nFrames" | "n_frames" => Ok(GeneratedField::NFrames),
                            "take" => Ok(GeneratedField::Take),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = ResolveTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.ResolveTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<ResolveTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut frames_done__ = None;
                let mut n_frames__ = None;
                let mut take__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::FramesDone => {
                            if frames_done__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesDone"));
                            }
                            frames_done__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NFrames => {
                            if n_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nFrames"));
                            }
                            n_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                    }
                }
                Ok(ResolveTakeResponse {
                    frames_done: frames_done__.unwrap_or_default(),
                    n_frames: n_frames__.unwrap_or_default(),
                    take: take__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.ResolveTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Role {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "ROLE_UNSPECIFIED",
            Self::Operator => "ROLE_OPERATOR",
            Self::Publisher => "ROLE_PUBLISHER",
            Self::Renderer => "ROLE_RENDERER",
            Self::Viewer => "ROLE_VIEWER",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for Role {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "ROLE_UNSPECIFIED",
            "ROLE_OPERATOR",
            "ROLE_PUBLISHER",
            "ROLE_RENDERER",
            "ROLE_VIEWER",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = Role;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "ROLE_UNSPECIFIED" => Ok(Role::Unspecified),
                    "ROLE_OPERATOR" => Ok(Role::Operator),
                    "ROLE_PUBLISHER" => Ok(Role::Publisher),
                    "ROLE_RENDERER" => Ok(Role::Renderer),
                    "ROLE_VIEWER" => Ok(Role::Viewer),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for SampleFlag {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "SAMPLE_FLAG_UNSPECIFIED",
            Self::Outlier => "SAMPLE_FLAG_OUTLIER",
            Self::Relabeled => "SAMPLE_FLAG_RELABELED",
            Self::TimeNonMonotonic => "SAMPLE_FLAG_TIME_NON_MONOTONIC",
            Self::TimecodeInvalid => "SAMPLE_FLAG_TIMECODE_INVALID",
            Self::Late => "SAMPLE_FLAG_LATE",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for SampleFlag {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "SAMPLE_FLAG_UNSPECIFIED",
            "SAMPLE_FLAG_OUTLIER",
            "SAMPLE_FLAG_RELABELED",
            "SAMPLE_FLAG_TIME_NON_MONOTONIC",
            "SAMPLE_FLAG_TIMECODE_INVALID",
            "SAMPLE_FLAG_LATE",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = SampleFlag;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "SAMPLE_FLAG_UNSPECIFIED" => Ok(SampleFlag::Unspecified),
                    "SAMPLE_FLAG_OUTLIER" => Ok(SampleFlag::Outlier),
                    "SAMPLE_FLAG_RELABELED" => Ok(SampleFlag::Relabeled),
                    "SAMPLE_FLAG_TIME_NON_MONOTONIC" => Ok(SampleFlag::TimeNonMonotonic),
                    "SAMPLE_FLAG_TIMECODE_INVALID" => Ok(SampleFlag::TimecodeInvalid),
                    "SAMPLE_FLAG_LATE" => Ok(SampleFlag::Late),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for Server {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.version.is_empty() {
            len += 1;
        }
        if self.start_time.is_some() {
            len += 1;
        }
        if self.tls {
            len += 1;
        }
        if self.tokens {
            len += 1;
        }
        if self.insecure {
            len += 1;
        }
        if self.draining {
            len += 1;
        }
        if self.caller.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Server", len)?;
        if !self.version.is_empty() {
            struct_ser.serialize_field("version", &self.version)?;
        }
        if let Some(v) = self.start_time.as_ref() {
            struct_ser.serialize_field("startTime", v)?;
        }
        if self.tls {
            struct_ser.serialize_field("tls", &self.tls)?;
        }
        if self.tokens {
            struct_ser.serialize_field("tokens", &self.tokens)?;
        }
        if self.insecure {
            struct_ser.serialize_field("insecure", &self.insecure)?;
        }
        if self.draining {
            struct_ser.serialize_field("draining", &self.draining)?;
        }
        if let Some(v) = self.caller.as_ref() {
            struct_ser.serialize_field("caller", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Server {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "version",
            "start_time",
            "startTime",
            "tls",
            "tokens",
            "insecure",
            "draining",
            "caller",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Version,
            StartTime,
            Tls,
            Tokens,
            Insecure,
            Draining,
            Caller,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "version" => Ok(GeneratedField::Version),
                            "startTime" | "start_time" => Ok(GeneratedField::StartTime),
                            "tls" => Ok(GeneratedField::Tls),
                            "tokens" => Ok(GeneratedField::Tokens),
                            "insecure" => Ok(GeneratedField::Insecure),
                            "draining" => Ok(GeneratedField::Draining),
                            "caller" => Ok(GeneratedField::Caller),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Server;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Server")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Server, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut version__ = None;
                let mut start_time__ = None;
                let mut tls__ = None;
                let mut tokens__ = None;
                let mut insecure__ = None;
                let mut draining__ = None;
                let mut caller__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Version => {
                            if version__.is_some() {
                                return Err(serde::de::Error::duplicate_field("version"));
                            }
                            version__ = Some(map_.next_value()?);
                        }
                        GeneratedField::StartTime => {
                            if start_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("startTime"));
                            }
                            start_time__ = map_.next_value()?;
                        }
                        GeneratedField::Tls => {
                            if tls__.is_some() {
                                return Err(serde::de::Error::duplicate_field("tls"));
                            }
                            tls__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Tokens => {
                            if tokens__.is_some() {
                                return Err(serde::de::Error::duplicate_field("tokens"));
                            }
                            tokens__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Insecure => {
                            if insecure__.is_some() {
                                return Err(serde::de::Error::duplicate_field("insecure"));
                            }
                            insecure__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Draining => {
                            if draining__.is_some() {
                                return Err(serde::de::Error::duplicate_field("draining"));
                            }
                            draining__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Caller => {
                            if caller__.is_some() {
                                return Err(serde::de::Error::duplicate_field("caller"));
                            }
                            caller__ = map_.next_value()?;
                        }
                    }
                }
                Ok(Server {
                    version: version__.unwrap_or_default(),
                    start_time: start_time__,
                    tls: tls__.unwrap_or_default(),
                    tokens: tokens__.unwrap_or_default(),
                    insecure: insecure__.unwrap_or_default(),
                    draining: draining__.unwrap_or_default(),
                    caller: caller__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Server", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Session {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if !self.display_name.is_empty() {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if self.kind != 0 {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        if self.create_time.is_some() {
            len += 1;
        }
        if self.status.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Session", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if !self.display_name.is_empty() {
            struct_ser.serialize_field("displayName", &self.display_name)?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if self.kind != 0 {
            let v = CaptureKind::try_from(self.kind)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.kind)))?;
            struct_ser.serialize_field("kind", &v)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        if let Some(v) = self.create_time.as_ref() {
            struct_ser.serialize_field("createTime", v)?;
        }
        if let Some(v) = self.status.as_ref() {
            struct_ser.serialize_field("status", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Session {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "display_name",
            "displayName",
            "actor",
            "kind",
            "settings",
            "create_time",
            "createTime",
            "status",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            DisplayName,
            Actor,
            Kind,
            Settings,
            CreateTime,
            Status,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "displayName" | "display_name" => Ok(GeneratedField::DisplayName),
                            "actor" => Ok(GeneratedField::Actor),
                            "kind" => Ok(GeneratedField::Kind),
                            "settings" => Ok(GeneratedField::Settings),
                            "createTime" | "create_time" => Ok(GeneratedField::CreateTime),
                            "status" => Ok(GeneratedField::Status),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Session;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Session")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Session, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut display_name__ = None;
                let mut actor__ = None;
                let mut kind__ = None;
                let mut settings__ = None;
                let mut create_time__ = None;
                let mut status__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::DisplayName => {
                            if display_name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("displayName"));
                            }
                            display_name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Kind => {
                            if kind__.is_some() {
                                return Err(serde::de::Error::duplicate_field("kind"));
                            }
                            kind__ = Some(map_.next_value::<CaptureKind>()? as i32);
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                        GeneratedField::CreateTime => {
                            if create_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("createTime"));
                            }
                            create_time__ = map_.next_value()?;
                        }
                        GeneratedField::Status => {
                            if status__.is_some() {
                                return Err(serde::de::Error::duplicate_field("status"));
                            }
                            status__ = map_.next_value()?;
                        }
                    }
                }
                Ok(Session {
                    name: name__.unwrap_or_default(),
                    display_name: display_name__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    kind: kind__.unwrap_or_default(),
                    settings: settings__,
                    create_time: create_time__,
                    status: status__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Session", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SessionSettings {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.neutral_frames.is_some() {
            len += 1;
        }
        if self.allow_exaggeration.is_some() {
            len += 1;
        }
        if self.smoothing.is_some() {
            len += 1;
        }
        if self.sparsity.is_some() {
            len += 1;
        }
        if self.robust.is_some() {
            len += 1;
        }
        if self.stabilize_head.is_some() {
            len += 1;
        }
        if self.stale_after.is_some() {
            len += 1;
        }
        if self.publisher_timeout.is_some() {
            len += 1;
        }
        if self.record.is_some() {
            len += 1;
        }
        if self.region_mode != 0 {
            len += 1;
        }
        if self.plain.is_some() {
            len += 1;
        }
        if self.align_on_request.is_some() {
            len += 1;
        }
        if self.record_images.is_some() {
            len += 1;
        }
        if self.symmetry.is_some() {
            len += 1;
        }
        if !self.bounds.is_empty() {
            len += 1;
        }
        if !self.exclusive_pairs.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SessionSettings", len)?;
        if let Some(v) = self.neutral_frames.as_ref() {
            struct_ser.serialize_field("neutralFrames", v)?;
        }
        if let Some(v) = self.allow_exaggeration.as_ref() {
            struct_ser.serialize_field("allowExaggeration", v)?;
        }
        if let Some(v) = self.smoothing.as_ref() {
            struct_ser.serialize_field("smoothing", v)?;
        }
        if let Some(v) = self.sparsity.as_ref() {
            struct_ser.serialize_field("sparsity", v)?;
        }
        if let Some(v) = self.robust.as_ref() {
            struct_ser.serialize_field("robust", v)?;
        }
        if let Some(v) = self.stabilize_head.as_ref() {
            struct_ser.serialize_field("stabilizeHead", v)?;
        }
        if let Some(v) = self.stale_after.as_ref() {
            struct_ser.serialize_field("staleAfter", v)?;
        }
        if let Some(v) = self.publisher_timeout.as_ref() {
            struct_ser.serialize_field("publisherTimeout", v)?;
        }
        if let Some(v) = self.record.as_ref() {
            struct_ser.serialize_field("record", v)?;
        }
        if self.region_mode != 0 {
            let v = RegionMode::try_from(self.region_mode)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.region_mode)))?;
            struct_ser.serialize_field("regionMode", &v)?;
        }
        if let Some(v) = self.plain.as_ref() {
            struct_ser.serialize_field("plain", v)?;
        }
        if let Some(v) = self.align_on_request.as_ref() {
            struct_ser.serialize_field("alignOnRequest", v)?;
        }
        if let Some(v) = self.record_images.as_ref() {
            struct_ser.serialize_field("recordImages", v)?;
        }
        if let Some(v) = self.symmetry.as_ref() {
            struct_ser.serialize_field("symmetry", v)?;
        }
        if !self.bounds.is_empty() {
            struct_ser.serialize_field("bounds", &self.bounds)?;
        }
        if !self.exclusive_pairs.is_empty() {
            struct_ser.serialize_field("exclusivePairs", &self.exclusive_pairs)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SessionSettings {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "neutral_frames",
            "neutralFrames",
            "allow_exaggeration",
            "allowExaggeration",
            "smoothing",
            "sparsity",
            "robust",
            "stabilize_head",
            "stabilizeHead",
            "stale_after",
            "staleAfter",
            "publisher_timeout",
            "publisherTimeout",
            "record",
            "region_mode",
            "regionMode",
            "plain",
            "align_on_request",
            "alignOnRequest",
            "record_images",
            "recordImages",
            "symmetry",
            "bounds",
            "exclusive_pairs",
            "exclusivePairs",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            NeutralFrames,
            AllowExaggeration,
            Smoothing,
            Sparsity,
            Robust,
            StabilizeHead,
            StaleAfter,
            PublisherTimeout,
            Record,
            RegionMode,
            Plain,
            AlignOnRequest,
            RecordImages,
            Symmetry,
            Bounds,
            ExclusivePairs,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "neutralFrames" | "neutral_frames" => Ok(GeneratedField::NeutralFrames),
                            "allowExaggeration" | "allow_exaggeration" => Ok(GeneratedField::AllowExaggeration),
                            "smoothing" => Ok(GeneratedField::Smoothing),
                            "sparsity" => Ok(GeneratedField::Sparsity),
                            "robust" => Ok(GeneratedField::Robust),
                            "stabilizeHead" | "stabilize_head" => Ok(GeneratedField::StabilizeHead),
                            "staleAfter" | "stale_after" => Ok(GeneratedField::StaleAfter),
                            "publisherTimeout" | "publisher_timeout" => Ok(GeneratedField::PublisherTimeout),
                            "record" => Ok(GeneratedField::Record),
                            "regionMode" | "region_mode" => Ok(GeneratedField::RegionMode),
                            "plain" => Ok(GeneratedField::Plain),
                            "alignOnRequest" | "align_on_request" => Ok(GeneratedField::AlignOnRequest),
                            "recordImages" | "record_images" => Ok(GeneratedField::RecordImages),
                            "symmetry" => Ok(GeneratedField::Symmetry),
                            "bounds" => Ok(GeneratedField::Bounds),
                            "exclusivePairs" | "exclusive_pairs" => Ok(GeneratedField::ExclusivePairs),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SessionSettings;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SessionSettings")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SessionSettings, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut neutral_frames__ = None;
                let mut allow_exaggeration__ = None;
                let mut smoothing__ = None;
                let mut sparsity__ = None;
                let mut robust__ = None;
                let mut stabilize_head__ = None;
                let mut stale_after__ = None;
                let mut publisher_timeout__ = None;
                let mut record__ = None;
                let mut region_mode__ = None;
                let mut plain__ = None;
                let mut align_on_request__ = None;
                let mut record_images__ = None;
                let mut symmetry__ = None;
                let mut bounds__ = None;
                let mut exclusive_pairs__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::NeutralFrames => {
                            if neutral_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("neutralFrames"));
                            }
                            neutral_frames__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::AllowExaggeration => {
                            if allow_exaggeration__.is_some() {
                                return Err(serde::de::Error::duplicate_field("allowExaggeration"));
                            }
                            allow_exaggeration__ = map_.next_value()?;
                        }
                        GeneratedField::Smoothing => {
                            if smoothing__.is_some() {
                                return Err(serde::de::Error::duplicate_field("smoothing"));
                            }
                            smoothing__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::Sparsity => {
                            if sparsity__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sparsity"));
                            }
                            sparsity__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::Robust => {
                            if robust__.is_some() {
                                return Err(serde::de::Error::duplicate_field("robust"));
                            }
                            robust__ = map_.next_value()?;
                        }
                        GeneratedField::StabilizeHead => {
                            if stabilize_head__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stabilizeHead"));
                            }
                            stabilize_head__ = map_.next_value()?;
                        }
                        GeneratedField::StaleAfter => {
                            if stale_after__.is_some() {
                                return Err(serde::de::Error::duplicate_field("staleAfter"));
                            }
                            stale_after__ = map_.next_value()?;
                        }
                        GeneratedField::PublisherTimeout => {
                            if publisher_timeout__.is_some() {
                                return Err(serde::de::Error::duplicate_field("publisherTimeout"));
                            }
                            publisher_timeout__ = map_.next_value()?;
                        }
                        GeneratedField::Record => {
                            if record__.is_some() {
                                return Err(serde::de::Error::duplicate_field("record"));
                            }
                            record__ = map_.next_value()?;
                        }
                        GeneratedField::RegionMode => {
                            if region_mode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("regionMode"));
                            }
                            region_mode__ = Some(map_.next_value::<RegionMode>()? as i32);
                        }
                        GeneratedField::Plain => {
                            if plain__.is_some() {
                                return Err(serde::de::Error::duplicate_field("plain"));
                            }
                            plain__ = map_.next_value()?;
                        }
                        GeneratedField::AlignOnRequest => {
                            if align_on_request__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignOnRequest"));
                            }
                            align_on_request__ = map_.next_value()?;
                        }
                        GeneratedField::RecordImages => {
                            if record_images__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recordImages"));
                            }
                            record_images__ = map_.next_value()?;
                        }
                        GeneratedField::Symmetry => {
                            if symmetry__.is_some() {
                                return Err(serde::de::Error::duplicate_field("symmetry"));
                            }
                            symmetry__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::Bounds => {
                            if bounds__.is_some() {
                                return Err(serde::de::Error::duplicate_field("bounds"));
                            }
                            bounds__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ExclusivePairs => {
                            if exclusive_pairs__.is_some() {
                                return Err(serde::de::Error::duplicate_field("exclusivePairs"));
                            }
                            exclusive_pairs__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(SessionSettings {
                    neutral_frames: neutral_frames__,
                    allow_exaggeration: allow_exaggeration__,
                    smoothing: smoothing__,
                    sparsity: sparsity__,
                    robust: robust__,
                    stabilize_head: stabilize_head__,
                    stale_after: stale_after__,
                    publisher_timeout: publisher_timeout__,
                    record: record__,
                    region_mode: region_mode__.unwrap_or_default(),
                    plain: plain__,
                    align_on_request: align_on_request__,
                    record_images: record_images__,
                    symmetry: symmetry__,
                    bounds: bounds__.unwrap_or_default(),
                    exclusive_pairs: exclusive_pairs__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SessionSettings", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SessionState {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "SESSION_STATE_UNSPECIFIED",
            Self::Waiting => "SESSION_STATE_WAITING",
            Self::Aligning => "SESSION_STATE_ALIGNING",
            Self::Live => "SESSION_STATE_LIVE",
            Self::Stale => "SESSION_STATE_STALE",
            Self::Ended => "SESSION_STATE_ENDED",
            Self::Failed => "SESSION_STATE_FAILED",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for SessionState {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "SESSION_STATE_UNSPECIFIED",
            "SESSION_STATE_WAITING",
            "SESSION_STATE_ALIGNING",
            "SESSION_STATE_LIVE",
            "SESSION_STATE_STALE",
            "SESSION_STATE_ENDED",
            "SESSION_STATE_FAILED",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = SessionState;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "SESSION_STATE_UNSPECIFIED" => Ok(SessionState::Unspecified),
                    "SESSION_STATE_WAITING" => Ok(SessionState::Waiting),
                    "SESSION_STATE_ALIGNING" => Ok(SessionState::Aligning),
                    "SESSION_STATE_LIVE" => Ok(SessionState::Live),
                    "SESSION_STATE_STALE" => Ok(SessionState::Stale),
                    "SESSION_STATE_ENDED" => Ok(SessionState::Ended),
                    "SESSION_STATE_FAILED" => Ok(SessionState::Failed),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for SessionStatus {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.state != 0 {
            len += 1;
        }
        if !self.failure.is_empty() {
            len += 1;
        }
        if self.last_frame != 0 {
            len += 1;
        }
        if self.frame_rate_hz != 0. {
            len += 1;
        }
        if self.frames_received != 0 {
            len += 1;
        }
        if self.frames_rejected != 0 {
            len += 1;
        }
        if self.frames_shed != 0 {
            len += 1;
        }
        if self.frames_missing != 0 {
            len += 1;
        }
        if self.alignment.is_some() {
            len += 1;
        }
        if !self.latencies.is_empty() {
            len += 1;
        }
        if !self.subscribers.is_empty() {
            len += 1;
        }
        if !self.take.is_empty() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if !self.ranges.is_empty() {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if !self.alignment_problem.is_empty() {
            len += 1;
        }
        if self.clock.is_some() {
            len += 1;
        }
        if !self.unknown_markers.is_empty() {
            len += 1;
        }
        if self.neutral_doubt.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SessionStatus", len)?;
        if self.state != 0 {
            let v = SessionState::try_from(self.state)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.state)))?;
            struct_ser.serialize_field("state", &v)?;
        }
        if !self.failure.is_empty() {
            struct_ser.serialize_field("failure", &self.failure)?;
        }
        if self.last_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastFrame", ToString::to_string(&self.last_frame).as_str())?;
        }
        if self.frame_rate_hz != 0. {
            struct_ser.serialize_field("frameRateHz", &self.frame_rate_hz)?;
        }
        if self.frames_received != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesReceived", ToString::to_string(&self.frames_received).as_str())?;
        }
        if self.frames_rejected != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesRejected", ToString::to_string(&self.frames_rejected).as_str())?;
        }
        if self.frames_shed != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesShed", ToString::to_string(&self.frames_shed).as_str())?;
        }
        if self.frames_missing != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("framesMissing", ToString::to_string(&self.frames_missing).as_str())?;
        }
        if let Some(v) = self.alignment.as_ref() {
            struct_ser.serialize_field("alignment", v)?;
        }
        if !self.latencies.is_empty() {
            struct_ser.serialize_field("latencies", &self.latencies)?;
        }
        if !self.subscribers.is_empty() {
            struct_ser.serialize_field("subscribers", &self.subscribers)?;
        }
        if !self.take.is_empty() {
            struct_ser.serialize_field("take", &self.take)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if !self.ranges.is_empty() {
            struct_ser.serialize_field("ranges", &self.ranges)?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if !self.alignment_problem.is_empty() {
            struct_ser.serialize_field("alignmentProblem", &self.alignment_problem)?;
        }
        if let Some(v) = self.clock.as_ref() {
            struct_ser.serialize_field("clock", v)?;
        }
        if !self.unknown_markers.is_empty() {
            struct_ser.serialize_field("unknownMarkers", &self.unknown_markers)?;
        }
        if let Some(v) = self.neutral_doubt.as_ref() {
            struct_ser.serialize_field("neutralDoubt", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SessionStatus {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "state",
            "failure",
            "last_frame",
            "lastFrame",
            "frame_rate_hz",
            "frameRateHz",
            "frames_received",
            "framesReceived",
            "frames_rejected",
            "framesRejected",
            "frames_shed",
            "framesShed",
            "frames_missing",
            "framesMissing",
            "alignment",
            "latencies",
            "subscribers",
            "take",
            "actor_revision",
            "actorRevision",
            "ranges",
            "run",
            "alignment_problem",
            "alignmentProblem",
            "clock",
            "unknown_markers",
            "unknownMarkers",
            "neutral_doubt",
            "neutralDoubt",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            State,
            Failure,
            LastFrame,
            FrameRateHz,
            FramesReceived,
            FramesRejected,
            FramesShed,
            FramesMissing,
            Alignment,
            Latencies,
            Subscribers,
            Take,
            ActorRevision,
            Ranges,
            Run,
            AlignmentProblem,
            Clock,
            UnknownMarkers,
            NeutralDoubt,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "state" => Ok(GeneratedField::State),
                            "failure" => Ok(GeneratedField::Failure),
                            "lastFrame" | "last_frame" => Ok(GeneratedField::LastFrame),
                            "frameRateHz" | "frame_rate_hz" => Ok(GeneratedField::FrameRateHz),
                            "framesReceived" | "frames_received" => Ok(GeneratedField::FramesReceived),
                            "framesRejected" | "frames_rejected" => Ok(GeneratedField::FramesRejected),
                            "framesShed" | "frames_shed" => Ok(GeneratedField::FramesShed),
                            "framesMissing" | "frames_missing" => Ok(GeneratedField::FramesMissing),
                            "alignment" => Ok(GeneratedField::Alignment),
                            "latencies" => Ok(GeneratedField::Latencies),
                            "subscribers" => Ok(GeneratedField::Subscribers),
                            "take" => Ok(GeneratedField::Take),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "ranges" => Ok(GeneratedField::Ranges),
                            "run" => Ok(GeneratedField::Run),
                            "alignmentProblem" | "alignment_problem" => Ok(GeneratedField::AlignmentProblem),
                            "clock" => Ok(GeneratedField::Clock),
                            "unknownMarkers" | "unknown_markers" => Ok(GeneratedField::UnknownMarkers),
                            "neutralDoubt" | "neutral_doubt" => Ok(GeneratedField::NeutralDoubt),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SessionStatus;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SessionStatus")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SessionStatus, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut state__ = None;
                let mut failure__ = None;
                let mut last_frame__ = None;
                let mut frame_rate_hz__ = None;
                let mut frames_received__ = None;
                let mut frames_rejected__ = None;
                let mut frames_shed__ = None;
                let mut frames_missing__ = None;
                let mut alignment__ = None;
                let mut latencies__ = None;
                let mut subscribers__ = None;
                let mut take__ = None;
                let mut actor_revision__ = None;
                let mut ranges__ = None;
                let mut run__ = None;
                let mut alignment_problem__ = None;
                let mut clock__ = None;
                let mut unknown_markers__ = None;
                let mut neutral_doubt__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::State => {
                            if state__.is_some() {
                                return Err(serde::de::Error::duplicate_field("state"));
                            }
                            state__ = Some(map_.next_value::<SessionState>()? as i32);
                        }
                        GeneratedField::Failure => {
                            if failure__.is_some() {
                                return Err(serde::de::Error::duplicate_field("failure"));
                            }
                            failure__ = Some(map_.next_value()?);
                        }
                        GeneratedField::LastFrame => {
                            if last_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastFrame"));
                            }
                            last_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FrameRateHz => {
                            if frame_rate_hz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("frameRateHz"));
                            }
                            frame_rate_hz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FramesReceived => {
                            if frames_received__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesReceived"));
                            }
                            frames_received__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FramesRejected => {
                            if frames_rejected__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesRejected"));
                            }
                            frames_rejected__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FramesShed => {
                            if frames_shed__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesShed"));
                            }
                            frames_shed__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FramesMissing => {
                            if frames_missing__.is_some() {
                                return Err(serde::de::Error::duplicate_field("framesMissing"));
                            }
                            frames_missing__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Alignment => {
                            if alignment__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignment"));
                            }
                            alignment__ = map_.next_value()?;
                        }
                        GeneratedField::Latencies => {
                            if latencies__.is_some() {
                                return Err(serde::de::Error::duplicate_field("latencies"));
                            }
                            latencies__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Subscribers => {
                            if subscribers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("subscribers"));
                            }
                            subscribers__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Ranges => {
                            if ranges__.is_some() {
                                return Err(serde::de::Error::duplicate_field("ranges"));
                            }
                            ranges__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::AlignmentProblem => {
                            if alignment_problem__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignmentProblem"));
                            }
                            alignment_problem__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Clock => {
                            if clock__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clock"));
                            }
                            clock__ = map_.next_value()?;
                        }
                        GeneratedField::UnknownMarkers => {
                            if unknown_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unknownMarkers"));
                            }
                            unknown_markers__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NeutralDoubt => {
                            if neutral_doubt__.is_some() {
                                return Err(serde::de::Error::duplicate_field("neutralDoubt"));
                            }
                            neutral_doubt__ = map_.next_value()?;
                        }
                    }
                }
                Ok(SessionStatus {
                    state: state__.unwrap_or_default(),
                    failure: failure__.unwrap_or_default(),
                    last_frame: last_frame__.unwrap_or_default(),
                    frame_rate_hz: frame_rate_hz__.unwrap_or_default(),
                    frames_received: frames_received__.unwrap_or_default(),
                    frames_rejected: frames_rejected__.unwrap_or_default(),
                    frames_shed: frames_shed__.unwrap_or_default(),
                    frames_missing: frames_missing__.unwrap_or_default(),
                    alignment: alignment__,
                    latencies: latencies__.unwrap_or_default(),
                    subscribers: subscribers__.unwrap_or_default(),
                    take: take__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    ranges: ranges__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    alignment_problem: alignment_problem__.unwrap_or_default(),
                    clock: clock__,
                    unknown_markers: unknown_markers__.unwrap_or_default(),
                    neutral_doubt: neutral_doubt__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SessionStatus", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StageLatency {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.stage.is_empty() {
            len += 1;
        }
        if self.latency.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StageLatency", len)?;
        if !self.stage.is_empty() {
            struct_ser.serialize_field("stage", &self.stage)?;
        }
        if let Some(v) = self.latency.as_ref() {
            struct_ser.serialize_field("latency", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StageLatency {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "stage",
            "latency",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Stage,
            Latency,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "stage" => Ok(GeneratedField::Stage),
                            "latency" => Ok(GeneratedField::Latency),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StageLatency;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StageLatency")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StageLatency, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut stage__ = None;
                let mut latency__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Stage => {
                            if stage__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stage"));
                            }
                            stage__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Latency => {
                            if latency__.is_some() {
                                return Err(serde::de::Error::duplicate_field("latency"));
                            }
                            latency__ = map_.next_value()?;
                        }
                    }
                }
                Ok(StageLatency {
                    stage: stage__.unwrap_or_default(),
                    latency: latency__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StageLatency", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StartTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.slate.is_empty() {
            len += 1;
        }
        if self.number != 0 {
            len += 1;
        }
        if !self.gesture.is_empty() {
            len += 1;
        }
        if self.with_images {
            len += 1;
        }
        if self.pre_roll.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StartTakeRequest", len)?;
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.slate.is_empty() {
            struct_ser.serialize_field("slate", &self.slate)?;
        }
        if self.number != 0 {
            struct_ser.serialize_field("number", &self.number)?;
        }
        if !self.gesture.is_empty() {
            struct_ser.serialize_field("gesture", &self.gesture)?;
        }
        if self.with_images {
            struct_ser.serialize_field("withImages", &self.with_images)?;
        }
        if let Some(v) = self.pre_roll.as_ref() {
            struct_ser.serialize_field("preRoll", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StartTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
            "slate",
            "number",
            "gesture",
            "with_images",
            "withImages",
            "pre_roll",
            "preRoll",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
            Slate,
            Number,
            Gesture,
            WithImages,
            PreRoll,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            "slate" => Ok(GeneratedField::Slate),
                            "number" => Ok(GeneratedField::Number),
                            "gesture" => Ok(GeneratedField::Gesture),
                            "withImages" | "with_images" => Ok(GeneratedField::WithImages),
                            "preRoll" | "pre_roll" => Ok(GeneratedField::PreRoll),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StartTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StartTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StartTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                let mut slate__ = None;
                let mut number__ = None;
                let mut gesture__ = None;
                let mut with_images__ = None;
                let mut pre_roll__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Slate => {
                            if slate__.is_some() {
                                return Err(serde::de::Error::duplicate_field("slate"));
                            }
                            slate__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Gesture => {
                            if gesture__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gesture"));
                            }
                            gesture__ = Some(map_.next_value()?);
                        }
                        GeneratedField::WithImages => {
                            if with_images__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withImages"));
                            }
                            with_images__ = Some(map_.next_value()?);
                        }
                        GeneratedField::PreRoll => {
                            if pre_roll__.is_some() {
                                return Err(serde::de::Error::duplicate_field("preRoll"));
                            }
                            pre_roll__ = map_.next_value()?;
                        }
                    }
                }
                Ok(StartTakeRequest {
                    session: session__.unwrap_or_default(),
                    slate: slate__.unwrap_or_default(),
                    number: number__.unwrap_or_default(),
                    gesture: gesture__.unwrap_or_default(),
                    with_images: with_images__.unwrap_or_default(),
                    pre_roll: pre_roll__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StartTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StartTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.take.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StartTakeResponse", len)?;
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StartTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StartTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StartTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StartTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                    }
                }
                Ok(StartTakeResponse {
                    take: take__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StartTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StateNumbers {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if !self.reals.is_empty() {
            len += 1;
        }
        if !self.integers.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StateNumbers", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if !self.reals.is_empty() {
            struct_ser.serialize_field("reals", &self.reals)?;
        }
        if !self.integers.is_empty() {
            struct_ser.serialize_field("integers", &self.integers.iter().map(ToString::to_string).collect::<Vec<_>>())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StateNumbers {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "reals",
            "integers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Reals,
            Integers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "reals" => Ok(GeneratedField::Reals),
                            "integers" => Ok(GeneratedField::Integers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StateNumbers;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StateNumbers")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StateNumbers, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut reals__ = None;
                let mut integers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Reals => {
                            if reals__.is_some() {
                                return Err(serde::de::Error::duplicate_field("reals"));
                            }
                            reals__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                        GeneratedField::Integers => {
                            if integers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("integers"));
                            }
                            integers__ = 
                                Some(map_.next_value::<Vec<::pbjson::private::NumberDeserialize<_>>>()?
                                    .into_iter().map(|x| x.0).collect())
                            ;
                        }
                    }
                }
                Ok(StateNumbers {
                    name: name__.unwrap_or_default(),
                    reals: reals__.unwrap_or_default(),
                    integers: integers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StateNumbers", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StopTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StopTakeRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StopTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StopTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StopTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StopTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(StopTakeRequest {
                    name: name__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StopTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StopTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.take.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StopTakeResponse", len)?;
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StopTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StopTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StopTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StopTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                    }
                }
                Ok(StopTakeResponse {
                    take: take__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StopTakeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for StreamState {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session_state != 0 {
            len += 1;
        }
        if self.last_frame_age_micros != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.StreamState", len)?;
        if self.session_state != 0 {
            let v = SessionState::try_from(self.session_state)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.session_state)))?;
            struct_ser.serialize_field("sessionState", &v)?;
        }
        if self.last_frame_age_micros != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastFrameAgeMicros", ToString::to_string(&self.last_frame_age_micros).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for StreamState {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session_state",
            "sessionState",
            "last_frame_age_micros",
            "lastFrameAgeMicros",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            SessionState,
            LastFrameAgeMicros,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "sessionState" | "session_state" => Ok(GeneratedField::SessionState),
                            "lastFrameAgeMicros" | "last_frame_age_micros" => Ok(GeneratedField::LastFrameAgeMicros),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = StreamState;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.StreamState")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<StreamState, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session_state__ = None;
                let mut last_frame_age_micros__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::SessionState => {
                            if session_state__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sessionState"));
                            }
                            session_state__ = Some(map_.next_value::<SessionState>()? as i32);
                        }
                        GeneratedField::LastFrameAgeMicros => {
                            if last_frame_age_micros__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastFrameAgeMicros"));
                            }
                            last_frame_age_micros__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(StreamState {
                    session_state: session_state__.unwrap_or_default(),
                    last_frame_age_micros: last_frame_age_micros__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.StreamState", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SubscribeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.start.is_some() {
            len += 1;
        }
        if self.credits != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SubscribeRequest", len)?;
        if let Some(v) = self.start.as_ref() {
            struct_ser.serialize_field("start", v)?;
        }
        if self.credits != 0 {
            struct_ser.serialize_field("credits", &self.credits)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SubscribeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "start",
            "credits",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Start,
            Credits,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "start" => Ok(GeneratedField::Start),
                            "credits" => Ok(GeneratedField::Credits),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SubscribeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SubscribeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SubscribeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut start__ = None;
                let mut credits__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Start => {
                            if start__.is_some() {
                                return Err(serde::de::Error::duplicate_field("start"));
                            }
                            start__ = map_.next_value()?;
                        }
                        GeneratedField::Credits => {
                            if credits__.is_some() {
                                return Err(serde::de::Error::duplicate_field("credits"));
                            }
                            credits__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(SubscribeRequest {
                    start: start__,
                    credits: credits__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SubscribeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SubscribeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.header.is_some() {
            len += 1;
        }
        if !self.samples.is_empty() {
            len += 1;
        }
        if self.skipped_samples != 0 {
            len += 1;
        }
        if !self.gaps.is_empty() {
            len += 1;
        }
        if self.state.is_some() {
            len += 1;
        }
        if self.end.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SubscribeResponse", len)?;
        if let Some(v) = self.header.as_ref() {
            struct_ser.serialize_field("header", v)?;
        }
        if !self.samples.is_empty() {
            struct_ser.serialize_field("samples", &self.samples)?;
        }
        if self.skipped_samples != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("skippedSamples", ToString::to_string(&self.skipped_samples).as_str())?;
        }
        if !self.gaps.is_empty() {
            struct_ser.serialize_field("gaps", &self.gaps)?;
        }
        if let Some(v) = self.state.as_ref() {
            struct_ser.serialize_field("state", v)?;
        }
        if let Some(v) = self.end.as_ref() {
            struct_ser.serialize_field("end", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SubscribeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "header",
            "samples",
            "skipped_samples",
            "skippedSamples",
            "gaps",
            "state",
            "end",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Header,
            Samples,
            SkippedSamples,
            Gaps,
            State,
            End,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "header" => Ok(GeneratedField::Header),
                            "samples" => Ok(GeneratedField::Samples),
                            "skippedSamples" | "skipped_samples" => Ok(GeneratedField::SkippedSamples),
                            "gaps" => Ok(GeneratedField::Gaps),
                            "state" => Ok(GeneratedField::State),
                            "end" => Ok(GeneratedField::End),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SubscribeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SubscribeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SubscribeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut header__ = None;
                let mut samples__ = None;
                let mut skipped_samples__ = None;
                let mut gaps__ = None;
                let mut state__ = None;
                let mut end__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Header => {
                            if header__.is_some() {
                                return Err(serde::de::Error::duplicate_field("header"));
                            }
                            header__ = map_.next_value()?;
                        }
                        GeneratedField::Samples => {
                            if samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("samples"));
                            }
                            samples__ = Some(map_.next_value()?);
                        }
                        GeneratedField::SkippedSamples => {
                            if skipped_samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("skippedSamples"));
                            }
                            skipped_samples__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Gaps => {
                            if gaps__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gaps"));
                            }
                            gaps__ = Some(map_.next_value()?);
                        }
                        GeneratedField::State => {
                            if state__.is_some() {
                                return Err(serde::de::Error::duplicate_field("state"));
                            }
                            state__ = map_.next_value()?;
                        }
                        GeneratedField::End => {
                            if end__.is_some() {
                                return Err(serde::de::Error::duplicate_field("end"));
                            }
                            end__ = map_.next_value()?;
                        }
                    }
                }
                Ok(SubscribeResponse {
                    header: header__,
                    samples: samples__.unwrap_or_default(),
                    skipped_samples: skipped_samples__.unwrap_or_default(),
                    gaps: gaps__.unwrap_or_default(),
                    state: state__,
                    end: end__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SubscribeResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SubscribeStart {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.subscriber.is_empty() {
            len += 1;
        }
        if self.delivery != 0 {
            len += 1;
        }
        if self.credits != 0 {
            len += 1;
        }
        if self.from_sequence != 0 {
            len += 1;
        }
        if self.control_space != 0 {
            len += 1;
        }
        if self.max_rate_hz != 0. {
            len += 1;
        }
        if self.with_uncertainty {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if self.from_oldest {
            len += 1;
        }
        if self.with_markers {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SubscribeStart", len)?;
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.subscriber.is_empty() {
            struct_ser.serialize_field("subscriber", &self.subscriber)?;
        }
        if self.delivery != 0 {
            let v = Delivery::try_from(self.delivery)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.delivery)))?;
            struct_ser.serialize_field("delivery", &v)?;
        }
        if self.credits != 0 {
            struct_ser.serialize_field("credits", &self.credits)?;
        }
        if self.from_sequence != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("fromSequence", ToString::to_string(&self.from_sequence).as_str())?;
        }
        if self.control_space != 0 {
            let v = ControlSpace::try_from(self.control_space)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.control_space)))?;
            struct_ser.serialize_field("controlSpace", &v)?;
        }
        if self.max_rate_hz != 0. {
            struct_ser.serialize_field("maxRateHz", &self.max_rate_hz)?;
        }
        if self.with_uncertainty {
            struct_ser.serialize_field("withUncertainty", &self.with_uncertainty)?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if self.from_oldest {
            struct_ser.serialize_field("fromOldest", &self.from_oldest)?;
        }
        if self.with_markers {
            struct_ser.serialize_field("withMarkers", &self.with_markers)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SubscribeStart {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
            "subscriber",
            "delivery",
            "credits",
            "from_sequence",
            "fromSequence",
            "control_space",
            "controlSpace",
            "max_rate_hz",
            "maxRateHz",
            "with_uncertainty",
            "withUncertainty",
            "run",
            "from_oldest",
            "fromOldest",
            "with_markers",
            "withMarkers",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
            Subscriber,
            Delivery,
            Credits,
            FromSequence,
            ControlSpace,
            MaxRateHz,
            WithUncertainty,
            Run,
            FromOldest,
            WithMarkers,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            "subscriber" => Ok(GeneratedField::Subscriber),
                            "delivery" => Ok(GeneratedField::Delivery),
                            "credits" => Ok(GeneratedField::Credits),
                            "fromSequence" | "from_sequence" => Ok(GeneratedField::FromSequence),
                            "controlSpace" | "control_space" => Ok(GeneratedField::ControlSpace),
                            "maxRateHz" | "max_rate_hz" => Ok(GeneratedField::MaxRateHz),
                            "withUncertainty" | "with_uncertainty" => Ok(GeneratedField::WithUncertainty),
                            "run" => Ok(GeneratedField::Run),
                            "fromOldest" | "from_oldest" => Ok(GeneratedField::FromOldest),
                            "withMarkers" | "with_markers" => Ok(GeneratedField::WithMarkers),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SubscribeStart;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SubscribeStart")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SubscribeStart, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                let mut subscriber__ = None;
                let mut delivery__ = None;
                let mut credits__ = None;
                let mut from_sequence__ = None;
                let mut control_space__ = None;
                let mut max_rate_hz__ = None;
                let mut with_uncertainty__ = None;
                let mut run__ = None;
                let mut from_oldest__ = None;
                let mut with_markers__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Subscriber => {
                            if subscriber__.is_some() {
                                return Err(serde::de::Error::duplicate_field("subscriber"));
                            }
                            subscriber__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Delivery => {
                            if delivery__.is_some() {
                                return Err(serde::de::Error::duplicate_field("delivery"));
                            }
                            delivery__ = Some(map_.next_value::<Delivery>()? as i32);
                        }
                        GeneratedField::Credits => {
                            if credits__.is_some() {
                                return Err(serde::de::Error::duplicate_field("credits"));
                            }
                            credits__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FromSequence => {
                            if from_sequence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("fromSequence"));
                            }
                            from_sequence__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ControlSpace => {
                            if control_space__.is_some() {
                                return Err(serde::de::Error::duplicate_field("controlSpace"));
                            }
                            control_space__ = Some(map_.next_value::<ControlSpace>()? as i32);
                        }
                        GeneratedField::MaxRateHz => {
                            if max_rate_hz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("maxRateHz"));
                            }
                            max_rate_hz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::WithUncertainty => {
                            if with_uncertainty__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withUncertainty"));
                            }
                            with_uncertainty__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::FromOldest => {
                            if from_oldest__.is_some() {
                                return Err(serde::de::Error::duplicate_field("fromOldest"));
                            }
                            from_oldest__ = Some(map_.next_value()?);
                        }
                        GeneratedField::WithMarkers => {
                            if with_markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withMarkers"));
                            }
                            with_markers__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(SubscribeStart {
                    session: session__.unwrap_or_default(),
                    subscriber: subscriber__.unwrap_or_default(),
                    delivery: delivery__.unwrap_or_default(),
                    credits: credits__.unwrap_or_default(),
                    from_sequence: from_sequence__.unwrap_or_default(),
                    control_space: control_space__.unwrap_or_default(),
                    max_rate_hz: max_rate_hz__.unwrap_or_default(),
                    with_uncertainty: with_uncertainty__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    from_oldest: from_oldest__.unwrap_or_default(),
                    with_markers: with_markers__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SubscribeStart", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for SubscriberStatus {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.subscriber.is_empty() {
            len += 1;
        }
        if !self.protocol.is_empty() {
            len += 1;
        }
        if self.sent_samples != 0 {
            len += 1;
        }
        if self.skipped_samples != 0 {
            len += 1;
        }
        if self.lag_frames != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.SubscriberStatus", len)?;
        if !self.subscriber.is_empty() {
            struct_ser.serialize_field("subscriber", &self.subscriber)?;
        }
        if !self.protocol.is_empty() {
            struct_ser.serialize_field("protocol", &self.protocol)?;
        }
        if self.sent_samples != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("sentSamples", ToString::to_string(&self.sent_samples).as_str())?;
        }
        if self.skipped_samples != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("skippedSamples", ToString::to_string(&self.skipped_samples).as_str())?;
        }
        if self.lag_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lagFrames", ToString::to_string(&self.lag_frames).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for SubscriberStatus {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "subscriber",
            "protocol",
            "sent_samples",
            "sentSamples",
            "skipped_samples",
            "skippedSamples",
            "lag_frames",
            "lagFrames",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Subscriber,
            Protocol,
            SentSamples,
            SkippedSamples,
            LagFrames,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "subscriber" => Ok(GeneratedField::Subscriber),
                            "protocol" => Ok(GeneratedField::Protocol),
                            "sentSamples" | "sent_samples" => Ok(GeneratedField::SentSamples),
                            "skippedSamples" | "skipped_samples" => Ok(GeneratedField::SkippedSamples),
                            "lagFrames" | "lag_frames" => Ok(GeneratedField::LagFrames),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = SubscriberStatus;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.SubscriberStatus")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<SubscriberStatus, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut subscriber__ = None;
                let mut protocol__ = None;
                let mut sent_samples__ = None;
                let mut skipped_samples__ = None;
                let mut lag_frames__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Subscriber => {
                            if subscriber__.is_some() {
                                return Err(serde::de::Error::duplicate_field("subscriber"));
                            }
                            subscriber__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Protocol => {
                            if protocol__.is_some() {
                                return Err(serde::de::Error::duplicate_field("protocol"));
                            }
                            protocol__ = Some(map_.next_value()?);
                        }
                        GeneratedField::SentSamples => {
                            if sent_samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sentSamples"));
                            }
                            sent_samples__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::SkippedSamples => {
                            if skipped_samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("skippedSamples"));
                            }
                            skipped_samples__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::LagFrames => {
                            if lag_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lagFrames"));
                            }
                            lag_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(SubscriberStatus {
                    subscriber: subscriber__.unwrap_or_default(),
                    protocol: protocol__.unwrap_or_default(),
                    sent_samples: sent_samples__.unwrap_or_default(),
                    skipped_samples: skipped_samples__.unwrap_or_default(),
                    lag_frames: lag_frames__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.SubscriberStatus", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Take {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if !self.session.is_empty() {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if !self.slate.is_empty() {
            len += 1;
        }
        if self.number != 0 {
            len += 1;
        }
        if self.start_time.is_some() {
            len += 1;
        }
        if self.stop_time.is_some() {
            len += 1;
        }
        if self.first_frame != 0 {
            len += 1;
        }
        if self.last_frame != 0 {
            len += 1;
        }
        if self.n_frames != 0 {
            len += 1;
        }
        if self.n_bytes != 0 {
            len += 1;
        }
        if self.recovered {
            len += 1;
        }
        if !self.gesture.is_empty() {
            len += 1;
        }
        if self.start_timecode.is_some() {
            len += 1;
        }
        if self.state != 0 {
            len += 1;
        }
        if self.circled {
            len += 1;
        }
        if !self.notes.is_empty() {
            len += 1;
        }
        if self.with_images {
            len += 1;
        }
        if !self.resolved_from.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Take", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if !self.slate.is_empty() {
            struct_ser.serialize_field("slate", &self.slate)?;
        }
        if self.number != 0 {
            struct_ser.serialize_field("number", &self.number)?;
        }
        if let Some(v) = self.start_time.as_ref() {
            struct_ser.serialize_field("startTime", v)?;
        }
        if let Some(v) = self.stop_time.as_ref() {
            struct_ser.serialize_field("stopTime", v)?;
        }
        if self.first_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("firstFrame", ToString::to_string(&self.first_frame).as_str())?;
        }
        if self.last_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastFrame", ToString::to_string(&self.last_frame).as_str())?;
        }
        if self.n_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nFrames", ToString::to_string(&self.n_frames).as_str())?;
        }
        if self.n_bytes != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nBytes", ToString::to_string(&self.n_bytes).as_str())?;
        }
        if self.recovered {
            struct_ser.serialize_field("recovered", &self.recovered)?;
        }
        if !self.gesture.is_empty() {
            struct_ser.serialize_field("gesture", &self.gesture)?;
        }
        if let Some(v) = self.start_timecode.as_ref() {
            struct_ser.serialize_field("startTimecode", v)?;
        }
        if self.state != 0 {
            let v = TakeState::try_from(self.state)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.state)))?;
            struct_ser.serialize_field("state", &v)?;
        }
        if self.circled {
            struct_ser.serialize_field("circled", &self.circled)?;
        }
        if !self.notes.is_empty() {
            struct_ser.serialize_field("notes", &self.notes)?;
        }
        if self.with_images {
            struct_ser.serialize_field("withImages", &self.with_images)?;
        }
        if !self.resolved_from.is_empty() {
            struct_ser.serialize_field("resolvedFrom", &self.resolved_from)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Take {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "session",
            "actor",
            "actor_revision",
            "actorRevision",
            "slate",
            "number",
            "start_time",
            "startTime",
            "stop_time",
            "stopTime",
            "first_frame",
            "firstFrame",
            "last_frame",
            "lastFrame",
            "n_frames",
            "nFrames",
            "n_bytes",
            "nBytes",
            "recovered",
            "gesture",
            "start_timecode",
            "startTimecode",
            "state",
            "circled",
            "notes",
            "with_images",
            "withImages",
            "resolved_from",
            "resolvedFrom",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Session,
            Actor,
            ActorRevision,
            Slate,
            Number,
            StartTime,
            StopTime,
            FirstFrame,
            LastFrame,
            NFrames,
            NBytes,
            Recovered,
            Gesture,
            StartTimecode,
            State,
            Circled,
            Notes,
            WithImages,
            ResolvedFrom,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "session" => Ok(GeneratedField::Session),
                            "actor" => Ok(GeneratedField::Actor),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "slate" => Ok(GeneratedField::Slate),
                            "number" => Ok(GeneratedField::Number),
                            "startTime" | "start_time" => Ok(GeneratedField::StartTime),
                            "stopTime" | "stop_time" => Ok(GeneratedField::StopTime),
                            "firstFrame" | "first_frame" => Ok(GeneratedField::FirstFrame),
                            "lastFrame" | "last_frame" => Ok(GeneratedField::LastFrame),
                            "nFrames" | "n_frames" => Ok(GeneratedField::NFrames),
                            "nBytes" | "n_bytes" => Ok(GeneratedField::NBytes),
                            "recovered" => Ok(GeneratedField::Recovered),
                            "gesture" => Ok(GeneratedField::Gesture),
                            "startTimecode" | "start_timecode" => Ok(GeneratedField::StartTimecode),
                            "state" => Ok(GeneratedField::State),
                            "circled" => Ok(GeneratedField::Circled),
                            "notes" => Ok(GeneratedField::Notes),
                            "withImages" | "with_images" => Ok(GeneratedField::WithImages),
                            "resolvedFrom" | "resolved_from" => Ok(GeneratedField::ResolvedFrom),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Take;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Take")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Take, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut session__ = None;
                let mut actor__ = None;
                let mut actor_revision__ = None;
                let mut slate__ = None;
                let mut number__ = None;
                let mut start_time__ = None;
                let mut stop_time__ = None;
                let mut first_frame__ = None;
                let mut last_frame__ = None;
                let mut n_frames__ = None;
                let mut n_bytes__ = None;
                let mut recovered__ = None;
                let mut gesture__ = None;
                let mut start_timecode__ = None;
                let mut state__ = None;
                let mut circled__ = None;
                let mut notes__ = None;
                let mut with_images__ = None;
                let mut resolved_from__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Slate => {
                            if slate__.is_some() {
                                return Err(serde::de::Error::duplicate_field("slate"));
                            }
                            slate__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::StartTime => {
                            if start_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("startTime"));
                            }
                            start_time__ = map_.next_value()?;
                        }
                        GeneratedField::StopTime => {
                            if stop_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stopTime"));
                            }
                            stop_time__ = map_.next_value()?;
                        }
                        GeneratedField::FirstFrame => {
                            if first_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("firstFrame"));
                            }
                            first_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::LastFrame => {
                            if last_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastFrame"));
                            }
                            last_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NFrames => {
                            if n_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nFrames"));
                            }
                            n_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NBytes => {
                            if n_bytes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nBytes"));
                            }
                            n_bytes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Recovered => {
                            if recovered__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recovered"));
                            }
                            recovered__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Gesture => {
                            if gesture__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gesture"));
                            }
                            gesture__ = Some(map_.next_value()?);
                        }
                        GeneratedField::StartTimecode => {
                            if start_timecode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("startTimecode"));
                            }
                            start_timecode__ = map_.next_value()?;
                        }
                        GeneratedField::State => {
                            if state__.is_some() {
                                return Err(serde::de::Error::duplicate_field("state"));
                            }
                            state__ = Some(map_.next_value::<TakeState>()? as i32);
                        }
                        GeneratedField::Circled => {
                            if circled__.is_some() {
                                return Err(serde::de::Error::duplicate_field("circled"));
                            }
                            circled__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Notes => {
                            if notes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("notes"));
                            }
                            notes__ = Some(map_.next_value()?);
                        }
                        GeneratedField::WithImages => {
                            if with_images__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withImages"));
                            }
                            with_images__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ResolvedFrom => {
                            if resolved_from__.is_some() {
                                return Err(serde::de::Error::duplicate_field("resolvedFrom"));
                            }
                            resolved_from__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(Take {
                    name: name__.unwrap_or_default(),
                    session: session__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    slate: slate__.unwrap_or_default(),
                    number: number__.unwrap_or_default(),
                    start_time: start_time__,
                    stop_time: stop_time__,
                    first_frame: first_frame__.unwrap_or_default(),
                    last_frame: last_frame__.unwrap_or_default(),
                    n_frames: n_frames__.unwrap_or_default(),
                    n_bytes: n_bytes__.unwrap_or_default(),
                    recovered: recovered__.unwrap_or_default(),
                    gesture: gesture__.unwrap_or_default(),
                    start_timecode: start_timecode__,
                    state: state__.unwrap_or_default(),
                    circled: circled__.unwrap_or_default(),
                    notes: notes__.unwrap_or_default(),
                    with_images: with_images__.unwrap_or_default(),
                    resolved_from: resolved_from__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Take", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeAlignment {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.actor_revision != 0 {
            len += 1;
        }
        if self.unit != 0 {
            len += 1;
        }
        if !self.marker_names.is_empty() {
            len += 1;
        }
        if !self.alignment_json.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeAlignment", len)?;
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if self.unit != 0 {
            let v = LengthUnit::try_from(self.unit)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.unit)))?;
            struct_ser.serialize_field("unit", &v)?;
        }
        if !self.marker_names.is_empty() {
            struct_ser.serialize_field("markerNames", &self.marker_names)?;
        }
        if !self.alignment_json.is_empty() {
            struct_ser.serialize_field("alignmentJson", &self.alignment_json)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeAlignment {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor_revision",
            "actorRevision",
            "unit",
            "marker_names",
            "markerNames",
            "alignment_json",
            "alignmentJson",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            ActorRevision,
            Unit,
            MarkerNames,
            AlignmentJson,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "unit" => Ok(GeneratedField::Unit),
                            "markerNames" | "marker_names" => Ok(GeneratedField::MarkerNames),
                            "alignmentJson" | "alignment_json" => Ok(GeneratedField::AlignmentJson),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeAlignment;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeAlignment")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeAlignment, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor_revision__ = None;
                let mut unit__ = None;
                let mut marker_names__ = None;
                let mut alignment_json__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Unit => {
                            if unit__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unit"));
                            }
                            unit__ = Some(map_.next_value::<LengthUnit>()? as i32);
                        }
                        GeneratedField::MarkerNames => {
                            if marker_names__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markerNames"));
                            }
                            marker_names__ = Some(map_.next_value()?);
                        }
                        GeneratedField::AlignmentJson => {
                            if alignment_json__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignmentJson"));
                            }
                            alignment_json__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(TakeAlignment {
                    actor_revision: actor_revision__.unwrap_or_default(),
                    unit: unit__.unwrap_or_default(),
                    marker_names: marker_names__.unwrap_or_default(),
                    alignment_json: alignment_json__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeAlignment", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeChange {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.actor_revision != 0 {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeChange", len)?;
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeChange {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor_revision",
            "actorRevision",
            "settings",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            ActorRevision,
            Settings,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "settings" => Ok(GeneratedField::Settings),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeChange;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeChange")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeChange, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor_revision__ = None;
                let mut settings__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                    }
                }
                Ok(TakeChange {
                    actor_revision: actor_revision__.unwrap_or_default(),
                    settings: settings__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeChange", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeClock {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.clock.is_some() {
            len += 1;
        }
        if self.server_time_nanos != 0 {
            len += 1;
        }
        if self.unix_offset_nanos != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeClock", len)?;
        if let Some(v) = self.clock.as_ref() {
            struct_ser.serialize_field("clock", v)?;
        }
        if self.server_time_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("serverTimeNanos", ToString::to_string(&self.server_time_nanos).as_str())?;
        }
        if self.unix_offset_nanos != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("unixOffsetNanos", ToString::to_string(&self.unix_offset_nanos).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeClock {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "clock",
            "server_time_nanos",
            "serverTimeNanos",
            "unix_offset_nanos",
            "unixOffsetNanos",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Clock,
            ServerTimeNanos,
            UnixOffsetNanos,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "clock" => Ok(GeneratedField::Clock),
                            "serverTimeNanos" | "server_time_nanos" => Ok(GeneratedField::ServerTimeNanos),
                            "unixOffsetNanos" | "unix_offset_nanos" => Ok(GeneratedField::UnixOffsetNanos),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeClock;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeClock")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeClock, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut clock__ = None;
                let mut server_time_nanos__ = None;
                let mut unix_offset_nanos__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Clock => {
                            if clock__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clock"));
                            }
                            clock__ = map_.next_value()?;
                        }
                        GeneratedField::ServerTimeNanos => {
                            if server_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("serverTimeNanos"));
                            }
                            server_time_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::UnixOffsetNanos => {
                            if unix_offset_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unixOffsetNanos"));
                            }
                            unix_offset_nanos__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(TakeClock {
                    clock: clock__,
                    server_time_nanos: server_time_nanos__.unwrap_or_default(),
                    unix_offset_nanos: unix_offset_nanos__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeClock", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeCut {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.n_bytes != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeCut", len)?;
        if self.n_bytes != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nBytes", ToString::to_string(&self.n_bytes).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeCut {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "n_bytes",
            "nBytes",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            NBytes,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "nBytes" | "n_bytes" => Ok(GeneratedField::NBytes),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeCut;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeCut")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeCut, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut n_bytes__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::NBytes => {
                            if n_bytes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nBytes"));
                            }
                            n_bytes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(TakeCut {
                    n_bytes: n_bytes__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeCut", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeEvent {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.event.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeEvent", len)?;
        if let Some(v) = self.event.as_ref() {
            match v {
                take_event::Event::Header(v) => {
                    struct_ser.serialize_field("header", v)?;
                }
                take_event::Event::Source(v) => {
                    struct_ser.serialize_field("source", v)?;
                }
                take_event::Event::Change(v) => {
                    struct_ser.serialize_field("change", v)?;
                }
                take_event::Event::Recenter(v) => {
                    struct_ser.serialize_field("recenter", v)?;
                }
                take_event::Event::Gap(v) => {
                    struct_ser.serialize_field("gap", v)?;
                }
                take_event::Event::State(v) => {
                    struct_ser.serialize_field("state", v)?;
                }
                take_event::Event::Alignment(v) => {
                    struct_ser.serialize_field("alignment", v)?;
                }
                take_event::Event::Stop(v) => {
                    struct_ser.serialize_field("stop", v)?;
                }
                take_event::Event::Cut(v) => {
                    struct_ser.serialize_field("cut", v)?;
                }
                take_event::Event::AnalysisState(v) => {
                    struct_ser.serialize_field("analysisState", v)?;
                }
                take_event::Event::Clock(v) => {
                    struct_ser.serialize_field("clock", v)?;
                }
            }
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeEvent {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "header",
            "source",
            "change",
            "recenter",
            "gap",
            "state",
            "alignment",
            "stop",
            "cut",
            "analysis_state",
            "analysisState",
            "clock",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Header,
            Source,
            Change,
            Recenter,
            Gap,
            State,
            Alignment,
            Stop,
            Cut,
            AnalysisState,
            Clock,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "header" => Ok(GeneratedField::Header),
                            "source" => Ok(GeneratedField::Source),
                            "change" => Ok(GeneratedField::Change),
                            "recenter" => Ok(GeneratedField::Recenter),
                            "gap" => Ok(GeneratedField::Gap),
                            "state" => Ok(GeneratedField::State),
                            "alignment" => Ok(GeneratedField::Alignment),
                            "stop" => Ok(GeneratedField::Stop),
                            "cut" => Ok(GeneratedField::Cut),
                            "analysisState" | "analysis_state" => Ok(GeneratedField::AnalysisState),
                            "clock" => Ok(GeneratedField::Clock),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeEvent;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeEvent")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeEvent, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut event__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Header => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("header"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Header)
;
                        }
                        GeneratedField::Source => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("source"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Source)
;
                        }
                        GeneratedField::Change => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("change"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Change)
;
                        }
                        GeneratedField::Recenter => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("recenter"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Recenter)
;
                        }
                        GeneratedField::Gap => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gap"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Gap)
;
                        }
                        GeneratedField::State => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("state"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::State)
;
                        }
                        GeneratedField::Alignment => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("alignment"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Alignment)
;
                        }
                        GeneratedField::Stop => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stop"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Stop)
;
                        }
                        GeneratedField::Cut => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("cut"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Cut)
;
                        }
                        GeneratedField::AnalysisState => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("analysisState"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::AnalysisState)
;
                        }
                        GeneratedField::Clock => {
                            if event__.is_some() {
                                return Err(serde::de::Error::duplicate_field("clock"));
                            }
                            event__ = map_.next_value::<::std::option::Option<_>>()?.map(take_event::Event::Clock)
;
                        }
                    }
                }
                Ok(TakeEvent {
                    event: event__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeEvent", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeExport {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.format != 0 {
            len += 1;
        }
        if !self.file_name.is_empty() {
            len += 1;
        }
        if self.first_frame != 0 {
            len += 1;
        }
        if self.last_frame != 0 {
            len += 1;
        }
        if self.n_frames != 0 {
            len += 1;
        }
        if self.n_gaps != 0 {
            len += 1;
        }
        if self.n_missing_frames != 0 {
            len += 1;
        }
        if !self.gaps.is_empty() {
            len += 1;
        }
        if self.n_dropped_frames != 0 {
            len += 1;
        }
        if self.start_timecode.is_some() {
            len += 1;
        }
        if self.n_bytes != 0 {
            len += 1;
        }
        if !self.sha256.is_empty() {
            len += 1;
        }
        if !self.undriven_shapes.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeExport", len)?;
        if self.format != 0 {
            let v = TakeFormat::try_from(self.format)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.format)))?;
            struct_ser.serialize_field("format", &v)?;
        }
        if !self.file_name.is_empty() {
            struct_ser.serialize_field("fileName", &self.file_name)?;
        }
        if self.first_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("firstFrame", ToString::to_string(&self.first_frame).as_str())?;
        }
        if self.last_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastFrame", ToString::to_string(&self.last_frame).as_str())?;
        }
        if self.n_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nFrames", ToString::to_string(&self.n_frames).as_str())?;
        }
        if self.n_gaps != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nGaps", ToString::to_string(&self.n_gaps).as_str())?;
        }
        if self.n_missing_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nMissingFrames", ToString::to_string(&self.n_missing_frames).as_str())?;
        }
        if !self.gaps.is_empty() {
            struct_ser.serialize_field("gaps", &self.gaps)?;
        }
        if self.n_dropped_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nDroppedFrames", ToString::to_string(&self.n_dropped_frames).as_str())?;
        }
        if let Some(v) = self.start_timecode.as_ref() {
            struct_ser.serialize_field("startTimecode", v)?;
        }
        if self.n_bytes != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nBytes", ToString::to_string(&self.n_bytes).as_str())?;
        }
        if !self.sha256.is_empty() {
            struct_ser.serialize_field("sha256", &self.sha256)?;
        }
        if !self.undriven_shapes.is_empty() {
            struct_ser.serialize_field("undrivenShapes", &self.undriven_shapes)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeExport {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "format",
            "file_name",
            "fileName",
            "first_frame",
            "firstFrame",
            "last_frame",
            "lastFrame",
            "n_frames",
            "nFrames",
            "n_gaps",
            "nGaps",
            "n_missing_frames",
            "nMissingFrames",
            "gaps",
            "n_dropped_frames",
            "nDroppedFrames",
            "start_timecode",
            "startTimecode",
            "n_bytes",
            "nBytes",
            "sha256",
            "undriven_shapes",
            "undrivenShapes",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Format,
            FileName,
            FirstFrame,
            LastFrame,
            NFrames,
            NGaps,
            NMissingFrames,
            Gaps,
            NDroppedFrames,
            StartTimecode,
            NBytes,
            Sha256,
            UndrivenShapes,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "format" => Ok(GeneratedField::Format),
                            "fileName" | "file_name" => Ok(GeneratedField::FileName),
                            "firstFrame" | "first_frame" => Ok(GeneratedField::FirstFrame),
                            "lastFrame" | "last_frame" => Ok(GeneratedField::LastFrame),
                            "nFrames" | "n_frames" => Ok(GeneratedField::NFrames),
                            "nGaps" | "n_gaps" => Ok(GeneratedField::NGaps),
                            "nMissingFrames" | "n_missing_frames" => Ok(GeneratedField::NMissingFrames),
                            "gaps" => Ok(GeneratedField::Gaps),
                            "nDroppedFrames" | "n_dropped_frames" => Ok(GeneratedField::NDroppedFrames),
                            "startTimecode" | "start_timecode" => Ok(GeneratedField::StartTimecode),
                            "nBytes" | "n_bytes" => Ok(GeneratedField::NBytes),
                            "sha256" => Ok(GeneratedField::Sha256),
                            "undrivenShapes" | "undriven_shapes" => Ok(GeneratedField::UndrivenShapes),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeExport;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeExport")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeExport, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut format__ = None;
                let mut file_name__ = None;
                let mut first_frame__ = None;
                let mut last_frame__ = None;
                let mut n_frames__ = None;
                let mut n_gaps__ = None;
                let mut n_missing_frames__ = None;
                let mut gaps__ = None;
                let mut n_dropped_frames__ = None;
                let mut start_timecode__ = None;
                let mut n_bytes__ = None;
                let mut sha256__ = None;
                let mut undriven_shapes__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Format => {
                            if format__.is_some() {
                                return Err(serde::de::Error::duplicate_field("format"));
                            }
                            format__ = Some(map_.next_value::<TakeFormat>()? as i32);
                        }
                        GeneratedField::FileName => {
                            if file_name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("fileName"));
                            }
                            file_name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::FirstFrame => {
                            if first_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("firstFrame"));
                            }
                            first_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::LastFrame => {
                            if last_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastFrame"));
                            }
                            last_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NFrames => {
                            if n_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nFrames"));
                            }
                            n_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NGaps => {
                            if n_gaps__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nGaps"));
                            }
                            n_gaps__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NMissingFrames => {
                            if n_missing_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nMissingFrames"));
                            }
                            n_missing_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Gaps => {
                            if gaps__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gaps"));
                            }
                            gaps__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NDroppedFrames => {
                            if n_dropped_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nDroppedFrames"));
                            }
                            n_dropped_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::StartTimecode => {
                            if start_timecode__.is_some() {
                                return Err(serde::de::Error::duplicate_field("startTimecode"));
                            }
                            start_timecode__ = map_.next_value()?;
                        }
                        GeneratedField::NBytes => {
                            if n_bytes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nBytes"));
                            }
                            n_bytes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Sha256 => {
                            if sha256__.is_some() {
                                return Err(serde::de::Error::duplicate_field("sha256"));
                            }
                            sha256__ = Some(map_.next_value()?);
                        }
                        GeneratedField::UndrivenShapes => {
                            if undriven_shapes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("undrivenShapes"));
                            }
                            undriven_shapes__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(TakeExport {
                    format: format__.unwrap_or_default(),
                    file_name: file_name__.unwrap_or_default(),
                    first_frame: first_frame__.unwrap_or_default(),
                    last_frame: last_frame__.unwrap_or_default(),
                    n_frames: n_frames__.unwrap_or_default(),
                    n_gaps: n_gaps__.unwrap_or_default(),
                    n_missing_frames: n_missing_frames__.unwrap_or_default(),
                    gaps: gaps__.unwrap_or_default(),
                    n_dropped_frames: n_dropped_frames__.unwrap_or_default(),
                    start_timecode: start_timecode__,
                    n_bytes: n_bytes__.unwrap_or_default(),
                    sha256: sha256__.unwrap_or_default(),
                    undriven_shapes: undriven_shapes__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeExport", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeFormat {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "TAKE_FORMAT_UNSPECIFIED",
            Self::Mcap => "TAKE_FORMAT_MCAP",
            Self::Csv => "TAKE_FORMAT_CSV",
            Self::LiveLinkCsv => "TAKE_FORMAT_LIVE_LINK_CSV",
            Self::Glb => "TAKE_FORMAT_GLB",
            Self::Trc => "TAKE_FORMAT_TRC",
            Self::C3d => "TAKE_FORMAT_C3D",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for TakeFormat {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "TAKE_FORMAT_UNSPECIFIED",
            "TAKE_FORMAT_MCAP",
            "TAKE_FORMAT_CSV",
            "TAKE_FORMAT_LIVE_LINK_CSV",
            "TAKE_FORMAT_GLB",
            "TAKE_FORMAT_TRC",
            "TAKE_FORMAT_C3D",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = TakeFormat;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "TAKE_FORMAT_UNSPECIFIED" => Ok(TakeFormat::Unspecified),
                    "TAKE_FORMAT_MCAP" => Ok(TakeFormat::Mcap),
                    "TAKE_FORMAT_CSV" => Ok(TakeFormat::Csv),
                    "TAKE_FORMAT_LIVE_LINK_CSV" => Ok(TakeFormat::LiveLinkCsv),
                    "TAKE_FORMAT_GLB" => Ok(TakeFormat::Glb),
                    "TAKE_FORMAT_TRC" => Ok(TakeFormat::Trc),
                    "TAKE_FORMAT_C3D" => Ok(TakeFormat::C3d),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for TakeHeader {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.take.is_empty() {
            len += 1;
        }
        if !self.session.is_empty() {
            len += 1;
        }
        if self.run != 0 {
            len += 1;
        }
        if !self.actor.is_empty() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if !self.package_sha256.is_empty() {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        if !self.slate.is_empty() {
            len += 1;
        }
        if self.number != 0 {
            len += 1;
        }
        if !self.gesture.is_empty() {
            len += 1;
        }
        if self.start_time.is_some() {
            len += 1;
        }
        if !self.controls.is_empty() {
            len += 1;
        }
        if !self.markers.is_empty() {
            len += 1;
        }
        if self.next_sequence != 0 {
            len += 1;
        }
        if !self.server_version.is_empty() {
            len += 1;
        }
        if self.next_frame != 0 {
            len += 1;
        }
        if !self.resolved_from.is_empty() {
            len += 1;
        }
        if self.pre_roll_from != 0 {
            len += 1;
        }
        if self.last_capture_time_nanos.is_some() {
            len += 1;
        }
        if self.with_images {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeHeader", len)?;
        if !self.take.is_empty() {
            struct_ser.serialize_field("take", &self.take)?;
        }
        if !self.session.is_empty() {
            struct_ser.serialize_field("session", &self.session)?;
        }
        if self.run != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("run", ToString::to_string(&self.run).as_str())?;
        }
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if !self.package_sha256.is_empty() {
            struct_ser.serialize_field("packageSha256", &self.package_sha256)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        if !self.slate.is_empty() {
            struct_ser.serialize_field("slate", &self.slate)?;
        }
        if self.number != 0 {
            struct_ser.serialize_field("number", &self.number)?;
        }
        if !self.gesture.is_empty() {
            struct_ser.serialize_field("gesture", &self.gesture)?;
        }
        if let Some(v) = self.start_time.as_ref() {
            struct_ser.serialize_field("startTime", v)?;
        }
        if !self.controls.is_empty() {
            struct_ser.serialize_field("controls", &self.controls)?;
        }
        if !self.markers.is_empty() {
            struct_ser.serialize_field("markers", &self.markers)?;
        }
        if self.next_sequence != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nextSequence", ToString::to_string(&self.next_sequence).as_str())?;
        }
        if !self.server_version.is_empty() {
            struct_ser.serialize_field("serverVersion", &self.server_version)?;
        }
        if self.next_frame != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nextFrame", ToString::to_string(&self.next_frame).as_str())?;
        }
        if !self.resolved_from.is_empty() {
            struct_ser.serialize_field("resolvedFrom", &self.resolved_from)?;
        }
        if self.pre_roll_from != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("preRollFrom", ToString::to_string(&self.pre_roll_from).as_str())?;
        }
        if let Some(v) = self.last_capture_time_nanos.as_ref() {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("lastCaptureTimeNanos", ToString::to_string(&v).as_str())?;
        }
        if self.with_images {
            struct_ser.serialize_field("withImages", &self.with_images)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeHeader {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
            "session",
            "run",
            "actor",
            "actor_revision",
            "actorRevision",
            "package_sha256",
            "packageSha256",
            "settings",
            "slate",
            "number",
            "gesture",
            "start_time",
            "startTime",
            "controls",
            "markers",
            "next_sequence",
            "nextSequence",
            "server_version",
            "serverVersion",
            "next_frame",
            "nextFrame",
            "resolved_from",
            "resolvedFrom",
            "pre_roll_from",
            "preRollFrom",
            "last_capture_time_nanos",
            "lastCaptureTimeNanos",
            "with_images",
            "withImages",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
            Session,
            Run,
            Actor,
            ActorRevision,
            PackageSha256,
            Settings,
            Slate,
            Number,
            Gesture,
            StartTime,
            Controls,
            Markers,
            NextSequence,
            ServerVersion,
            NextFrame,
            ResolvedFrom,
            PreRollFrom,
            LastCaptureTimeNanos,
            WithImages,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            "session" => Ok(GeneratedField::Session),
                            "run" => Ok(GeneratedField::Run),
                            "actor" => Ok(GeneratedField::Actor),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "packageSha256" | "package_sha256" => Ok(GeneratedField::PackageSha256),
                            "settings" => Ok(GeneratedField::Settings),
                            "slate" => Ok(GeneratedField::Slate),
                            "number" => Ok(GeneratedField::Number),
                            "gesture" => Ok(GeneratedField::Gesture),
                            "startTime" | "start_time" => Ok(GeneratedField::StartTime),
                            "controls" => Ok(GeneratedField::Controls),
                            "markers" => Ok(GeneratedField::Markers),
                            "nextSequence" | "next_sequence" => Ok(GeneratedField::NextSequence),
                            "serverVersion" | "server_version" => Ok(GeneratedField::ServerVersion),
                            "nextFrame" | "next_frame" => Ok(GeneratedField::NextFrame),
                            "resolvedFrom" | "resolved_from" => Ok(GeneratedField::ResolvedFrom),
                            "preRollFrom" | "pre_roll_from" => Ok(GeneratedField::PreRollFrom),
                            "lastCaptureTimeNanos" | "last_capture_time_nanos" => Ok(GeneratedField::LastCaptureTimeNanos),
                            "withImages" | "with_images" => Ok(GeneratedField::WithImages),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeHeader;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeHeader")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeHeader, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                let mut session__ = None;
                let mut run__ = None;
                let mut actor__ = None;
                let mut actor_revision__ = None;
                let mut package_sha256__ = None;
                let mut settings__ = None;
                let mut slate__ = None;
                let mut number__ = None;
                let mut gesture__ = None;
                let mut start_time__ = None;
                let mut controls__ = None;
                let mut markers__ = None;
                let mut next_sequence__ = None;
                let mut server_version__ = None;
                let mut next_frame__ = None;
                let mut resolved_from__ = None;
                let mut pre_roll_from__ = None;
                let mut last_capture_time_nanos__ = None;
                let mut with_images__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Run => {
                            if run__.is_some() {
                                return Err(serde::de::Error::duplicate_field("run"));
                            }
                            run__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::PackageSha256 => {
                            if package_sha256__.is_some() {
                                return Err(serde::de::Error::duplicate_field("packageSha256"));
                            }
                            package_sha256__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                        GeneratedField::Slate => {
                            if slate__.is_some() {
                                return Err(serde::de::Error::duplicate_field("slate"));
                            }
                            slate__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Number => {
                            if number__.is_some() {
                                return Err(serde::de::Error::duplicate_field("number"));
                            }
                            number__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Gesture => {
                            if gesture__.is_some() {
                                return Err(serde::de::Error::duplicate_field("gesture"));
                            }
                            gesture__ = Some(map_.next_value()?);
                        }
                        GeneratedField::StartTime => {
                            if start_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("startTime"));
                            }
                            start_time__ = map_.next_value()?;
                        }
                        GeneratedField::Controls => {
                            if controls__.is_some() {
                                return Err(serde::de::Error::duplicate_field("controls"));
                            }
                            controls__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Markers => {
                            if markers__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markers"));
                            }
                            markers__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NextSequence => {
                            if next_sequence__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextSequence"));
                            }
                            next_sequence__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ServerVersion => {
                            if server_version__.is_some() {
                                return Err(serde::de::Error::duplicate_field("serverVersion"));
                            }
                            server_version__ = Some(map_.next_value()?);
                        }
                        GeneratedField::NextFrame => {
                            if next_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nextFrame"));
                            }
                            next_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::ResolvedFrom => {
                            if resolved_from__.is_some() {
                                return Err(serde::de::Error::duplicate_field("resolvedFrom"));
                            }
                            resolved_from__ = Some(map_.next_value()?);
                        }
                        GeneratedField::PreRollFrom => {
                            if pre_roll_from__.is_some() {
                                return Err(serde::de::Error::duplicate_field("preRollFrom"));
                            }
                            pre_roll_from__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::LastCaptureTimeNanos => {
                            if last_capture_time_nanos__.is_some() {
                                return Err(serde::de::Error::duplicate_field("lastCaptureTimeNanos"));
                            }
                            last_capture_time_nanos__ = 
                                map_.next_value::<::std::option::Option<::pbjson::private::NumberDeserialize<_>>>()?.map(|x| x.0)
                            ;
                        }
                        GeneratedField::WithImages => {
                            if with_images__.is_some() {
                                return Err(serde::de::Error::duplicate_field("withImages"));
                            }
                            with_images__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(TakeHeader {
                    take: take__.unwrap_or_default(),
                    session: session__.unwrap_or_default(),
                    run: run__.unwrap_or_default(),
                    actor: actor__.unwrap_or_default(),
                    actor_revision: actor_revision__.unwrap_or_default(),
                    package_sha256: package_sha256__.unwrap_or_default(),
                    settings: settings__,
                    slate: slate__.unwrap_or_default(),
                    number: number__.unwrap_or_default(),
                    gesture: gesture__.unwrap_or_default(),
                    start_time: start_time__,
                    controls: controls__.unwrap_or_default(),
                    markers: markers__.unwrap_or_default(),
                    next_sequence: next_sequence__.unwrap_or_default(),
                    server_version: server_version__.unwrap_or_default(),
                    next_frame: next_frame__.unwrap_or_default(),
                    resolved_from: resolved_from__.unwrap_or_default(),
                    pre_roll_from: pre_roll_from__.unwrap_or_default(),
                    last_capture_time_nanos: last_capture_time_nanos__,
                    with_images: with_images__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeHeader", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeRecenter {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.source != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeRecenter", len)?;
        if self.source != 0 {
            let v = NeutralSource::try_from(self.source)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.source)))?;
            struct_ser.serialize_field("source", &v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeRecenter {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "source",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Source,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "source" => Ok(GeneratedField::Source),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeRecenter;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeRecenter")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeRecenter, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut source__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Source => {
                            if source__.is_some() {
                                return Err(serde::de::Error::duplicate_field("source"));
                            }
                            source__ = Some(map_.next_value::<NeutralSource>()? as i32);
                        }
                    }
                }
                Ok(TakeRecenter {
                    source: source__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeRecenter", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeSource {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.publisher.is_empty() {
            len += 1;
        }
        if self.epoch != 0 {
            len += 1;
        }
        if self.unit != 0 {
            len += 1;
        }
        if !self.marker_names.is_empty() {
            len += 1;
        }
        if self.rate_hz != 0. {
            len += 1;
        }
        if self.continued {
            len += 1;
        }
        if self.is_other {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeSource", len)?;
        if !self.publisher.is_empty() {
            struct_ser.serialize_field("publisher", &self.publisher)?;
        }
        if self.epoch != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("epoch", ToString::to_string(&self.epoch).as_str())?;
        }
        if self.unit != 0 {
            let v = LengthUnit::try_from(self.unit)
                .map_err(|_| serde::ser::Error::custom(format!("Invalid variant {}", self.unit)))?;
            struct_ser.serialize_field("unit", &v)?;
        }
        if !self.marker_names.is_empty() {
            struct_ser.serialize_field("markerNames", &self.marker_names)?;
        }
        if self.rate_hz != 0. {
            struct_ser.serialize_field("rateHz", &self.rate_hz)?;
        }
        if self.continued {
            struct_ser.serialize_field("continued", &self.continued)?;
        }
        if self.is_other {
            struct_ser.serialize_field("isOther", &self.is_other)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeSource {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "publisher",
            "epoch",
            "unit",
            "marker_names",
            "markerNames",
            "rate_hz",
            "rateHz",
            "continued",
            "is_other",
            "isOther",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Publisher,
            Epoch,
            Unit,
            MarkerNames,
            RateHz,
            Continued,
            IsOther,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "publisher" => Ok(GeneratedField::Publisher),
                            "epoch" => Ok(GeneratedField::Epoch),
                            "unit" => Ok(GeneratedField::Unit),
                            "markerNames" | "marker_names" => Ok(GeneratedField::MarkerNames),
                            "rateHz" | "rate_hz" => Ok(GeneratedField::RateHz),
                            "continued" => Ok(GeneratedField::Continued),
                            "isOther" | "is_other" => Ok(GeneratedField::IsOther),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeSource;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeSource")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeSource, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut publisher__ = None;
                let mut epoch__ = None;
                let mut unit__ = None;
                let mut marker_names__ = None;
                let mut rate_hz__ = None;
                let mut continued__ = None;
                let mut is_other__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Publisher => {
                            if publisher__.is_some() {
                                return Err(serde::de::Error::duplicate_field("publisher"));
                            }
                            publisher__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Epoch => {
                            if epoch__.is_some() {
                                return Err(serde::de::Error::duplicate_field("epoch"));
                            }
                            epoch__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Unit => {
                            if unit__.is_some() {
                                return Err(serde::de::Error::duplicate_field("unit"));
                            }
                            unit__ = Some(map_.next_value::<LengthUnit>()? as i32);
                        }
                        GeneratedField::MarkerNames => {
                            if marker_names__.is_some() {
                                return Err(serde::de::Error::duplicate_field("markerNames"));
                            }
                            marker_names__ = Some(map_.next_value()?);
                        }
                        GeneratedField::RateHz => {
                            if rate_hz__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rateHz"));
                            }
                            rate_hz__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Continued => {
                            if continued__.is_some() {
                                return Err(serde::de::Error::duplicate_field("continued"));
                            }
                            continued__ = Some(map_.next_value()?);
                        }
                        GeneratedField::IsOther => {
                            if is_other__.is_some() {
                                return Err(serde::de::Error::duplicate_field("isOther"));
                            }
                            is_other__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(TakeSource {
                    publisher: publisher__.unwrap_or_default(),
                    epoch: epoch__.unwrap_or_default(),
                    unit: unit__.unwrap_or_default(),
                    marker_names: marker_names__.unwrap_or_default(),
                    rate_hz: rate_hz__.unwrap_or_default(),
                    continued: continued__.unwrap_or_default(),
                    is_other: is_other__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeSource", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TakeState {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        let variant = match self {
            Self::Unspecified => "TAKE_STATE_UNSPECIFIED",
            Self::Recording => "TAKE_STATE_RECORDING",
            Self::Closed => "TAKE_STATE_CLOSED",
            Self::Degraded => "TAKE_STATE_DEGRADED",
            Self::TruncatedDiskFull => "TAKE_STATE_TRUNCATED_DISK_FULL",
            Self::Quarantined => "TAKE_STATE_QUARANTINED",
            Self::Recovering => "TAKE_STATE_RECOVERING",
        };
        serializer.serialize_str(variant)
    }
}
impl<'de> serde::Deserialize<'de> for TakeState {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "TAKE_STATE_UNSPECIFIED",
            "TAKE_STATE_RECORDING",
            "TAKE_STATE_CLOSED",
            "TAKE_STATE_DEGRADED",
            "TAKE_STATE_TRUNCATED_DISK_FULL",
            "TAKE_STATE_QUARANTINED",
            "TAKE_STATE_RECOVERING",
        ];

        struct GeneratedVisitor;

        impl serde::de::Visitor<'_> for GeneratedVisitor {
            type Value = TakeState;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(formatter, "expected one of: {:?}", &FIELDS)
            }

            fn visit_i64<E>(self, v: i64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Signed(v), &self)
                    })
            }

            fn visit_u64<E>(self, v: u64) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                i32::try_from(v)
                    .ok()
                    .and_then(|x| x.try_into().ok())
                    .ok_or_else(|| {
                        serde::de::Error::invalid_value(serde::de::Unexpected::Unsigned(v), &self)
                    })
            }

            fn visit_str<E>(self, value: &str) -> std::result::Result<Self::Value, E>
            where
                E: serde::de::Error,
            {
                match value {
                    "TAKE_STATE_UNSPECIFIED" => Ok(TakeState::Unspecified),
                    "TAKE_STATE_RECORDING" => Ok(TakeState::Recording),
                    "TAKE_STATE_CLOSED" => Ok(TakeState::Closed),
                    "TAKE_STATE_DEGRADED" => Ok(TakeState::Degraded),
                    "TAKE_STATE_TRUNCATED_DISK_FULL" => Ok(TakeState::TruncatedDiskFull),
                    "TAKE_STATE_QUARANTINED" => Ok(TakeState::Quarantined),
                    "TAKE_STATE_RECOVERING" => Ok(TakeState::Recovering),
                    _ => Err(serde::de::Error::unknown_variant(value, FIELDS)),
                }
            }
        }
        deserializer.deserialize_any(GeneratedVisitor)
    }
}
impl serde::Serialize for TakeStop {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.stop_time.is_some() {
            len += 1;
        }
        if self.n_frames != 0 {
            len += 1;
        }
        if self.n_samples != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TakeStop", len)?;
        if let Some(v) = self.stop_time.as_ref() {
            struct_ser.serialize_field("stopTime", v)?;
        }
        if self.n_frames != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nFrames", ToString::to_string(&self.n_frames).as_str())?;
        }
        if self.n_samples != 0 {
            #[allow(clippy::needless_borrow)]
            #[allow(clippy::needless_borrows_for_generic_args)]
            struct_ser.serialize_field("nSamples", ToString::to_string(&self.n_samples).as_str())?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TakeStop {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "stop_time",
            "stopTime",
            "n_frames",
            "nFrames",
            "n_samples",
            "nSamples",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            StopTime,
            NFrames,
            NSamples,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "stopTime" | "stop_time" => Ok(GeneratedField::StopTime),
                            "nFrames" | "n_frames" => Ok(GeneratedField::NFrames),
                            "nSamples" | "n_samples" => Ok(GeneratedField::NSamples),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TakeStop;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TakeStop")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TakeStop, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut stop_time__ = None;
                let mut n_frames__ = None;
                let mut n_samples__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::StopTime => {
                            if stop_time__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stopTime"));
                            }
                            stop_time__ = map_.next_value()?;
                        }
                        GeneratedField::NFrames => {
                            if n_frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nFrames"));
                            }
                            n_frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::NSamples => {
                            if n_samples__.is_some() {
                                return Err(serde::de::Error::duplicate_field("nSamples"));
                            }
                            n_samples__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(TakeStop {
                    stop_time: stop_time__,
                    n_frames: n_frames__.unwrap_or_default(),
                    n_samples: n_samples__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TakeStop", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for Timecode {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.hours != 0 {
            len += 1;
        }
        if self.minutes != 0 {
            len += 1;
        }
        if self.seconds != 0 {
            len += 1;
        }
        if self.frames != 0 {
            len += 1;
        }
        if self.rate_numerator != 0 {
            len += 1;
        }
        if self.rate_denominator != 0 {
            len += 1;
        }
        if self.drop_frame {
            len += 1;
        }
        if self.sub_frame != 0. {
            len += 1;
        }
        if self.user_bits != 0 {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.Timecode", len)?;
        if self.hours != 0 {
            struct_ser.serialize_field("hours", &self.hours)?;
        }
        if self.minutes != 0 {
            struct_ser.serialize_field("minutes", &self.minutes)?;
        }
        if self.seconds != 0 {
            struct_ser.serialize_field("seconds", &self.seconds)?;
        }
        if self.frames != 0 {
            struct_ser.serialize_field("frames", &self.frames)?;
        }
        if self.rate_numerator != 0 {
            struct_ser.serialize_field("rateNumerator", &self.rate_numerator)?;
        }
        if self.rate_denominator != 0 {
            struct_ser.serialize_field("rateDenominator", &self.rate_denominator)?;
        }
        if self.drop_frame {
            struct_ser.serialize_field("dropFrame", &self.drop_frame)?;
        }
        if self.sub_frame != 0. {
            struct_ser.serialize_field("subFrame", &self.sub_frame)?;
        }
        if self.user_bits != 0 {
            struct_ser.serialize_field("userBits", &self.user_bits)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for Timecode {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "hours",
            "minutes",
            "seconds",
            "frames",
            "rate_numerator",
            "rateNumerator",
            "rate_denominator",
            "rateDenominator",
            "drop_frame",
            "dropFrame",
            "sub_frame",
            "subFrame",
            "user_bits",
            "userBits",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Hours,
            Minutes,
            Seconds,
            Frames,
            RateNumerator,
            RateDenominator,
            DropFrame,
            SubFrame,
            UserBits,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "hours" => Ok(GeneratedField::Hours),
                            "minutes" => Ok(GeneratedField::Minutes),
                            "seconds" => Ok(GeneratedField::Seconds),
                            "frames" => Ok(GeneratedField::Frames),
                            "rateNumerator" | "rate_numerator" => Ok(GeneratedField::RateNumerator),
                            "rateDenominator" | "rate_denominator" => Ok(GeneratedField::RateDenominator),
                            "dropFrame" | "drop_frame" => Ok(GeneratedField::DropFrame),
                            "subFrame" | "sub_frame" => Ok(GeneratedField::SubFrame),
                            "userBits" | "user_bits" => Ok(GeneratedField::UserBits),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = Timecode;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.Timecode")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<Timecode, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut hours__ = None;
                let mut minutes__ = None;
                let mut seconds__ = None;
                let mut frames__ = None;
                let mut rate_numerator__ = None;
                let mut rate_denominator__ = None;
                let mut drop_frame__ = None;
                let mut sub_frame__ = None;
                let mut user_bits__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Hours => {
                            if hours__.is_some() {
                                return Err(serde::de::Error::duplicate_field("hours"));
                            }
                            hours__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Minutes => {
                            if minutes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("minutes"));
                            }
                            minutes__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Seconds => {
                            if seconds__.is_some() {
                                return Err(serde::de::Error::duplicate_field("seconds"));
                            }
                            seconds__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Frames => {
                            if frames__.is_some() {
                                return Err(serde::de::Error::duplicate_field("frames"));
                            }
                            frames__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RateNumerator => {
                            if rate_numerator__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rateNumerator"));
                            }
                            rate_numerator__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::RateDenominator => {
                            if rate_denominator__.is_some() {
                                return Err(serde::de::Error::duplicate_field("rateDenominator"));
                            }
                            rate_denominator__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::DropFrame => {
                            if drop_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("dropFrame"));
                            }
                            drop_frame__ = Some(map_.next_value()?);
                        }
                        GeneratedField::SubFrame => {
                            if sub_frame__.is_some() {
                                return Err(serde::de::Error::duplicate_field("subFrame"));
                            }
                            sub_frame__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::UserBits => {
                            if user_bits__.is_some() {
                                return Err(serde::de::Error::duplicate_field("userBits"));
                            }
                            user_bits__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                    }
                }
                Ok(Timecode {
                    hours: hours__.unwrap_or_default(),
                    minutes: minutes__.unwrap_or_default(),
                    seconds: seconds__.unwrap_or_default(),
                    frames: frames__.unwrap_or_default(),
                    rate_numerator: rate_numerator__.unwrap_or_default(),
                    rate_denominator: rate_denominator__.unwrap_or_default(),
                    drop_frame: drop_frame__.unwrap_or_default(),
                    sub_frame: sub_frame__.unwrap_or_default(),
                    user_bits: user_bits__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.Timecode", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TrainRegionsRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.actor.is_empty() {
            len += 1;
        }
        if !self.takes.is_empty() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TrainRegionsRequest", len)?;
        if !self.actor.is_empty() {
            struct_ser.serialize_field("actor", &self.actor)?;
        }
        if !self.takes.is_empty() {
            struct_ser.serialize_field("takes", &self.takes)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TrainRegionsRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "actor",
            "takes",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Actor,
            Takes,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "actor" => Ok(GeneratedField::Actor),
                            "takes" => Ok(GeneratedField::Takes),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TrainRegionsRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TrainRegionsRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TrainRegionsRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut actor__ = None;
                let mut takes__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Takes => {
                            if takes__.is_some() {
                                return Err(serde::de::Error::duplicate_field("takes"));
                            }
                            takes__ = Some(map_.next_value()?);
                        }
                    }
                }
                Ok(TrainRegionsRequest {
                    actor: actor__.unwrap_or_default(),
                    takes: takes__.unwrap_or_default(),
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TrainRegionsRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for TrainRegionsResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.stage.is_empty() {
            len += 1;
        }
        if self.fraction != 0. {
            len += 1;
        }
        if self.actor.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.TrainRegionsResponse", len)?;
        if !self.stage.is_empty() {
            struct_ser.serialize_field("stage", &self.stage)?;
        }
        if self.fraction != 0. {
            struct_ser.serialize_field("fraction", &self.fraction)?;
        }
        if let Some(v) = self.actor.as_ref() {
            struct_ser.serialize_field("actor", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for TrainRegionsResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "stage",
            "fraction",
            "actor",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Stage,
            Fraction,
            Actor,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "stage" => Ok(GeneratedField::Stage),
                            "fraction" => Ok(GeneratedField::Fraction),
                            "actor" => Ok(GeneratedField::Actor),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = TrainRegionsResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.TrainRegionsResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<TrainRegionsResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut stage__ = None;
                let mut fraction__ = None;
                let mut actor__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Stage => {
                            if stage__.is_some() {
                                return Err(serde::de::Error::duplicate_field("stage"));
                            }
                            stage__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Fraction => {
                            if fraction__.is_some() {
                                return Err(serde::de::Error::duplicate_field("fraction"));
                            }
                            fraction__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::Actor => {
                            if actor__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actor"));
                            }
                            actor__ = map_.next_value()?;
                        }
                    }
                }
                Ok(TrainRegionsResponse {
                    stage: stage__.unwrap_or_default(),
                    fraction: fraction__.unwrap_or_default(),
                    actor: actor__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.TrainRegionsResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for UpdateSessionRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if !self.name.is_empty() {
            len += 1;
        }
        if self.settings.is_some() {
            len += 1;
        }
        if self.actor_revision != 0 {
            len += 1;
        }
        if self.update_mask.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.UpdateSessionRequest", len)?;
        if !self.name.is_empty() {
            struct_ser.serialize_field("name", &self.name)?;
        }
        if let Some(v) = self.settings.as_ref() {
            struct_ser.serialize_field("settings", v)?;
        }
        if self.actor_revision != 0 {
            struct_ser.serialize_field("actorRevision", &self.actor_revision)?;
        }
        if let Some(v) = self.update_mask.as_ref() {
            struct_ser.serialize_field("updateMask", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for UpdateSessionRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "name",
            "settings",
            "actor_revision",
            "actorRevision",
            "update_mask",
            "updateMask",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Name,
            Settings,
            ActorRevision,
            UpdateMask,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "name" => Ok(GeneratedField::Name),
                            "settings" => Ok(GeneratedField::Settings),
                            "actorRevision" | "actor_revision" => Ok(GeneratedField::ActorRevision),
                            "updateMask" | "update_mask" => Ok(GeneratedField::UpdateMask),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = UpdateSessionRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.UpdateSessionRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<UpdateSessionRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut name__ = None;
                let mut settings__ = None;
                let mut actor_revision__ = None;
                let mut update_mask__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Name => {
                            if name__.is_some() {
                                return Err(serde::de::Error::duplicate_field("name"));
                            }
                            name__ = Some(map_.next_value()?);
                        }
                        GeneratedField::Settings => {
                            if settings__.is_some() {
                                return Err(serde::de::Error::duplicate_field("settings"));
                            }
                            settings__ = map_.next_value()?;
                        }
                        GeneratedField::ActorRevision => {
                            if actor_revision__.is_some() {
                                return Err(serde::de::Error::duplicate_field("actorRevision"));
                            }
                            actor_revision__ = 
                                Some(map_.next_value::<::pbjson::private::NumberDeserialize<_>>()?.0)
                            ;
                        }
                        GeneratedField::UpdateMask => {
                            if update_mask__.is_some() {
                                return Err(serde::de::Error::duplicate_field("updateMask"));
                            }
                            update_mask__ = map_.next_value()?;
                        }
                    }
                }
                Ok(UpdateSessionRequest {
                    name: name__.unwrap_or_default(),
                    settings: settings__,
                    actor_revision: actor_revision__.unwrap_or_default(),
                    update_mask: update_mask__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.UpdateSessionRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for UpdateSessionResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.session.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.UpdateSessionResponse", len)?;
        if let Some(v) = self.session.as_ref() {
            struct_ser.serialize_field("session", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for UpdateSessionResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "session",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Session,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "session" => Ok(GeneratedField::Session),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = UpdateSessionResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.UpdateSessionResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<UpdateSessionResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut session__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Session => {
                            if session__.is_some() {
                                return Err(serde::de::Error::duplicate_field("session"));
                            }
                            session__ = map_.next_value()?;
                        }
                    }
                }
                Ok(UpdateSessionResponse {
                    session: session__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.UpdateSessionResponse", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for UpdateTakeRequest {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.take.is_some() {
            len += 1;
        }
        if self.update_mask.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.UpdateTakeRequest", len)?;
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        if let Some(v) = self.update_mask.as_ref() {
            struct_ser.serialize_field("updateMask", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for UpdateTakeRequest {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
            "update_mask",
            "updateMask",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
            UpdateMask,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            "updateMask" | "update_mask" => Ok(GeneratedField::UpdateMask),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = UpdateTakeRequest;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.UpdateTakeRequest")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<UpdateTakeRequest, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                let mut update_mask__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                        GeneratedField::UpdateMask => {
                            if update_mask__.is_some() {
                                return Err(serde::de::Error::duplicate_field("updateMask"));
                            }
                            update_mask__ = map_.next_value()?;
                        }
                    }
                }
                Ok(UpdateTakeRequest {
                    take: take__,
                    update_mask: update_mask__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.UpdateTakeRequest", FIELDS, GeneratedVisitor)
    }
}
impl serde::Serialize for UpdateTakeResponse {
    #[allow(deprecated)]
    fn serialize<S>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error>
    where
        S: serde::Serializer,
    {
        use serde::ser::SerializeStruct;
        let mut len = 0;
        if self.take.is_some() {
            len += 1;
        }
        let mut struct_ser = serializer.serialize_struct("frontalis.v1.UpdateTakeResponse", len)?;
        if let Some(v) = self.take.as_ref() {
            struct_ser.serialize_field("take", v)?;
        }
        struct_ser.end()
    }
}
impl<'de> serde::Deserialize<'de> for UpdateTakeResponse {
    #[allow(deprecated)]
    fn deserialize<D>(deserializer: D) -> std::result::Result<Self, D::Error>
    where
        D: serde::Deserializer<'de>,
    {
        const FIELDS: &[&str] = &[
            "take",
        ];

        #[allow(clippy::enum_variant_names)]
        enum GeneratedField {
            Take,
        }
        impl<'de> serde::Deserialize<'de> for GeneratedField {
            fn deserialize<D>(deserializer: D) -> std::result::Result<GeneratedField, D::Error>
            where
                D: serde::Deserializer<'de>,
            {
                struct GeneratedVisitor;

                impl serde::de::Visitor<'_> for GeneratedVisitor {
                    type Value = GeneratedField;

                    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        write!(formatter, "expected one of: {:?}", &FIELDS)
                    }

                    #[allow(unused_variables)]
                    fn visit_str<E>(self, value: &str) -> std::result::Result<GeneratedField, E>
                    where
                        E: serde::de::Error,
                    {
                        match value {
                            "take" => Ok(GeneratedField::Take),
                            _ => Err(serde::de::Error::unknown_field(value, FIELDS)),
                        }
                    }
                }
                deserializer.deserialize_identifier(GeneratedVisitor)
            }
        }
        struct GeneratedVisitor;
        impl<'de> serde::de::Visitor<'de> for GeneratedVisitor {
            type Value = UpdateTakeResponse;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("struct frontalis.v1.UpdateTakeResponse")
            }

            fn visit_map<V>(self, mut map_: V) -> std::result::Result<UpdateTakeResponse, V::Error>
                where
                    V: serde::de::MapAccess<'de>,
            {
                let mut take__ = None;
                while let Some(k) = map_.next_key()? {
                    match k {
                        GeneratedField::Take => {
                            if take__.is_some() {
                                return Err(serde::de::Error::duplicate_field("take"));
                            }
                            take__ = map_.next_value()?;
                        }
                    }
                }
                Ok(UpdateTakeResponse {
                    take: take__,
                })
            }
        }
        deserializer.deserialize_struct("frontalis.v1.UpdateTakeResponse", FIELDS, GeneratedVisitor)
    }
}
